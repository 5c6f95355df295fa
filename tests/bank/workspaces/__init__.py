"""The bank of answers about files and terminals."""

"""The bank of answers: what learners type, right and wrong, and what they must be told."""

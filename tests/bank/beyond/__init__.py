"""Answers to the exercises of pages 07 to 13, a module for each page."""

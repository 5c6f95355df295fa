"""Answers to the exercises about nodes, page by page; see `bank.answer`."""

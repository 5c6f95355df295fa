"""Submissions that are hostile or broken: what they try, and what has to become of them."""

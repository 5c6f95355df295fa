"""What runs inside a sandbox, beside a stranger's code.

Nothing in here decides about a mark, and nothing in here knows a right answer: it runs an answer
and writes down what it did. Imports nothing of judges; a test says so.
"""

"""The scenarios: whatever runs an answer or looks at it, and what they write down as evidence.

Nothing here knows a right answer. So a scenario may run in one process with a stranger's code, and
what it has seen is judged in another one.
"""

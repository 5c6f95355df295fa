"""From an observation to an outcome, and from an outcome to what a learner reads.

Nothing here runs a learner's code or imports ROS: a judge is a pure function of plain data.
"""

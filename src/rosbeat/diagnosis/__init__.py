"""Name the mistake that was made: pure functions from evidence to the name of a mistake.

Nothing here imports ROS, runs a learner's code or reads a file. `mistakes` names what can go wrong;
every other module recognises some of it, in an exception, in a graph that stays silent, or in what
a program printed. What is not recognised is `mistakes.UNKNOWN`, never the nearest name.
"""

"""Build a learner's page and a solution page from each lesson source, and check the sources.

::

    source     reads src/lessons/NN_slug.py into a Lesson; finds the lessons of a checkout
    pages      the two trees, each made in a few steps
    execution  runs a page from top to bottom in a kernel of its own
    lint       the rules, one function each, for `rosbeat lint`
    build      compares or writes all derived files, for `rosbeat build`

Only the command line and the tests import this package. It never imports rclpy.
"""

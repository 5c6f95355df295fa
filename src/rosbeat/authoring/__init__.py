"""Lesson sources become a learner's page and a solution page; lints keep them honest.

::

    source    reads src/lessons/NN_slug.py into a Lesson
    markers   the answer markers inside a cell
    identity  cell ids that survive edits
    transforms/  one step from a source to a page per module
    kernel    a private Jupyter kernel: this interpreter, sockets instead of ports
    execution runs a page from top to bottom
    layout    where a checkout keeps what
    pages     the two trees, each a list of transformations
    pictures  what of a page is pixels
    files     compares and writes, all or nothing
    builder   ties the rest together for `rosbeat build`
    lint/     one small function per rule, for `rosbeat lint`

Only the command line and the tests import this package. It never imports rclpy.
"""

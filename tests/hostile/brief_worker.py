"""A worker of `rosbeat.grading` whose answers have less time and memory; run as a program."""

import sys
from functools import partial

from rosbeat.grading.start_worker import UNSAFE, settle


def main(options):
    """Answer jobs, with other limits."""
    settle(options)
    # Only now, for it starts threads.
    from rosbeat.grading import worker
    from rosbeat.grading.sandbox.limits import MB, Limits
    from rosbeat.ros import scenario

    worker.WALL = 4.0
    # To use up a whole gigabyte takes a busy machine seconds; an answer needs less than 50 MB.
    worker.Limits = partial(Limits, memory=200 * MB)
    scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time
    worker.main(unsafe=UNSAFE in options)


if __name__ == "__main__":
    main(sys.argv[1:])

"""A worker of `rosbeat.grading` whose answers have less time and memory; run as a program."""

import sys
from functools import partial

from rosbeat.grading import worker


def main(options):
    """Answer jobs, with other limits."""
    worker.WALL, worker.LOST_AT_MOST = 3.5, 5.0
    worker.HURRIED, worker.PATIENCE = 1 / 3, 0.8
    # To use up a whole gigabyte takes a busy machine seconds; an answer needs less than 50 MB.
    worker.Limits = partial(worker.Limits, memory=200 * 1_000_000)
    prepare = worker.prepare

    def prepare_with_less_time():
        prepare()
        from rosbeat.ros import scenario

        scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time

    worker.prepare = prepare_with_less_time
    worker.main(options)


if __name__ == "__main__":
    main(sys.argv[1:])

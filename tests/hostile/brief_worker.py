"""A worker of `rosbeat.grading` whose answers have less time and memory; run as a program."""

import sys
from functools import partial

from rosbeat.grading import worker


def main(options):
    """Answer jobs, with other limits."""
    worker.WALL = 10.0
    # To use up a whole gigabyte takes a busy machine seconds; a page needs half of this.
    worker.Limits = partial(worker.Limits, memory=300 * 1_000_000)
    prepare = worker.prepare

    def prepare_with_less_time():
        prepare()
        from rosbeat.grading import page_process

        page_process.CELL_SECONDS, page_process.CHECK_SECONDS = 4.0, 3.5
        page_process.GRACE = 1.5
        page_process.LOST_AT_MOST, page_process.HURRIED = 5.0, 1 / 3
        from rosbeat.ros import scenario

        scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time

    worker.prepare = prepare_with_less_time
    worker.main(options)


if __name__ == "__main__":
    main(sys.argv[1:])

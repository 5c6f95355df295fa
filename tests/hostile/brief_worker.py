"""What runs inside of a sandbox of `rosbeat.grading`, where answers have less time."""

import sys

from rosbeat.page_runs import worker


def prepare():
    """Import what answers need, and give them less time."""
    worker.prepare()
    from rosbeat.page_runs import page_process

    page_process.CELL_SECONDS, page_process.CHECK_SECONDS = 4.0, 3.5
    page_process.GRACE = 1.5
    page_process.LOST_AT_MOST, page_process.HURRIED = 5.0, 1 / 3
    from rosbeat.ros import scenario

    scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time


if __name__ == "__main__":
    worker.serve(int(sys.argv[-1]), worker.UNSAFE not in sys.argv, prepare)

"""A worker of `rosbeat.grading` whose answers have less time; run as a program."""

import sys

from rosbeat.grading import worker
from rosbeat.runtime import scenario

worker.WALL = 4.0
scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time

if __name__ == "__main__":
    worker.main(unsafe=worker.UNSAFE in sys.argv[1:])

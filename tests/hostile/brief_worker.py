"""A worker of `rosbeat.grading` whose answers have less time and memory; run as a program."""

import sys
from functools import partial

from rosbeat.grading import worker
from rosbeat.grading.sandbox.limits import MB, Limits
from rosbeat.runtime import scenario

worker.WALL = 4.0
# On a busy machine it takes seconds to use up a whole gigabyte; an answer needs less than 50 MB.
worker.Limits = partial(Limits, memory=200 * MB)
scenario.observe.__kwdefaults__["deadline"] = 1.5  # what an answer has in virtual time

if __name__ == "__main__":
    worker.main(unsafe=worker.UNSAFE in sys.argv[1:])

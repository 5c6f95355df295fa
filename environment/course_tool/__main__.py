"""Entry point of `python -I environment/course_tool`."""

import sys
from pathlib import Path

# `-I` keeps foreign paths out (a sourced ROS, a user site), and this package with them.
sys.path.insert(0, str(Path(__file__).resolve().parent.parent))

from course_tool.cli import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

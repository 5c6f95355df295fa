"""Run `ros2` as `python -m ros2_command`."""

import sys

from ros2_command.main import main

sys.exit(main())

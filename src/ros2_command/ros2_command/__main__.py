"""`python -m ros2_command` is `ros2`."""

import sys

from ros2_command.main import main

sys.exit(main())

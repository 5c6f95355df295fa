"""`python -m rosbeat` is `rosbeat`."""

from __future__ import annotations

import sys

from rosbeat.cli import main

sys.exit(main())

"""Each test owns its sessions."""

from session_fixtures import eventually, ros, says, slept

__all__ = ["eventually", "ros", "says", "slept"]

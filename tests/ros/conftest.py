"""Each test owns its sessions."""

from session_fixtures import eventually, ros, says

__all__ = ["eventually", "ros", "says"]

"""Each test owns its sessions."""

from session_fixtures import empty_domain, eventually, ros, says, slept

__all__ = ["empty_domain", "eventually", "ros", "says", "slept"]

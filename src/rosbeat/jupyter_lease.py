"""Lease a ROS domain in Jupyter servers and kernels, whose terminals inherit it.

JupyterLab and `jupyterhub-singleuser` load this module as a server extension, which the
configuration in `.venv/etc/jupyter` names. A kernel, such as one that an editor has started, leases
when `rosbeat` is imported.
"""

from __future__ import annotations

import os
import sys
from typing import Any

from rosbeat.domains import lease_terminal_domain
from rosbeat.errors import DomainsExhaustedError

__all__ = ["hold_domain"]


def hold_domain() -> None:
    """Hold the domain of this user's terminals until this process ends.

    If there is none left, say so on standard error, and keep the domain as it is.
    """
    try:
        lease = lease_terminal_domain(os.environ)
    except DomainsExhaustedError as error:
        print(error, file=sys.stderr)
        return
    if lease is not None:
        lease.keep()


def _jupyter_server_extension_points() -> list[dict[str, str]]:
    return [{"module": __name__}]


def _load_jupyter_server_extension(_: Any) -> None:  # noqa: ANN401 - Jupyter carries no types here
    # Before any kernel or terminal is started.
    hold_domain()

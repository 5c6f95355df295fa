"""A real JupyterLab in a folder of its own, with the looks and settings of the course."""

import json
import os
import shutil
import subprocess
import sys
import time
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from rosbeat.domains import lease_domain

_COURSE = Path(__file__).parents[2] / "environment"
#: The style sheet that `course lab` adds to JupyterLab.
STYLE = _COURSE / "lab_style" / "custom.css"
_SETTINGS = _COURSE / "course_tool" / "lab_files" / "share" / "jupyter" / "lab" / "settings"
_DEADLINE = 90


@dataclass(frozen=True)
class Lab:
    """A server that answers.

    Attributes:
        url: Its address, with a slash at the end.
        root: The folder it shows.
    """

    url: str
    root: Path


@contextmanager
def lab_server(folder, root):
    """Start JupyterLab, and end it with all of its kernels."""
    lease = lease_domain()
    environment = _environment(folder, lease.domain_id)
    with (folder / "lab.log").open("w") as log:
        process = subprocess.Popen(
            [sys.executable, "-m", "jupyterlab", *_options(folder, root)],
            env=environment, stdout=log, stderr=subprocess.STDOUT, cwd=root,
        )  # fmt: skip
        try:
            yield Lab(_address(process, folder), root)
        finally:
            process.terminate()
            process.wait(30)
            lease.release()


def _options(folder, root):
    settings = folder / "settings"
    shutil.copytree(_SETTINGS, settings)
    return [
        *("--no-browser", "--allow-root", "--ServerApp.port=0", "--ServerApp.token="),
        *("--ServerApp.password=", "--ServerApp.disable_check_xsrf=True"),
        *(f"--ServerApp.root_dir={root}", f"--LabApp.app_settings_dir={settings}"),
        f"--LabApp.user_settings_dir={folder / 'user'}",
        *("--LabApp.expose_app_in_browser=True", "--LabApp.custom_css=True"),
        f"--ServerApp.tornado_settings={ {'static_custom_path': [str(STYLE.parent)]}!r}",
    ]


def _environment(folder, domain_id):
    own = {
        "JUPYTER_RUNTIME_DIR": str(folder / "run"),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_DATA_DIR": str(folder / "data"),
        "JUPYTER_PREFER_ENV_PATH": "1",
        "IPYTHONDIR": str(folder / "ipython"),
        "ROS_DOMAIN_ID": str(domain_id),
        "ROSBEAT_WORKSPACE_IN": str(folder),
        "ROSBEAT_PROGRESS_IN": str(folder),
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
    }
    kept = {k: v for k, v in os.environ.items() if not k.startswith("PYTEST")}
    return {**kept, **own}


def _address(process, folder):
    deadline = time.monotonic() + _DEADLINE
    while time.monotonic() < deadline and process.poll() is None:
        for path in (folder / "run").glob("jpserver-*.json"):
            text = path.read_text()
            if text.endswith("}") or text.endswith("}\n"):
                return json.loads(text)["url"]
        time.sleep(0.05)
    raise RuntimeError("JupyterLab did not start:\n" + (folder / "lab.log").read_text()[-3000:])

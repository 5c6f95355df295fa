"""A workspace and terminals of each test's own, with the package of the course if asked for."""

import sys

import pytest
from IPython.core.interactiveshell import InteractiveShell
from traitlets.config import Config

from rosbeat import workspace
from rosbeat.workspace.prerequisites import NODES, PACKAGE, finished
from rosbeat.workspace.terminals import Terminals

SETUP_CFG = (
    f"[develop]\nscript_dir=$base/lib/{PACKAGE}\n[install]\ninstall_scripts=$base/lib/{PACKAGE}\n"
)


@pytest.fixture
def root(tmp_path, monkeypatch):
    """An empty workspace, which is also where a page would find it."""
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(tmp_path))
    root = tmp_path / "ROS2_and_RL_Tutorials"
    (root / "src").mkdir(parents=True)
    return root


def write(path, text):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")


@pytest.fixture
def package(root):
    """The finished package in the folder src."""
    folder = root / "src" / PACKAGE
    for name in ("package.xml", "setup.py", *(f"{PACKAGE}/{node}.py" for node in NODES)):
        write(folder / name, finished(name))
    write(folder / "setup.cfg", SETUP_CFG)
    write(folder / "resource" / PACKAGE, "")
    write(folder / PACKAGE / "__init__.py", "")
    return folder


@pytest.fixture
def installed(root, package):
    """What a build of the finished package leaves, as far as it is looked at."""
    prefix = root / "install" / PACKAGE
    library = prefix / "lib" / "python3.11" / "site-packages"
    write(prefix / "share" / PACKAGE / "package.xml", "")
    for node in NODES:
        write(library / PACKAGE / f"{node}.py", finished(f"{PACKAGE}/{node}.py"))
        write(prefix / "lib" / PACKAGE / node, "#!/usr/bin/env python3\n")
        (prefix / "lib" / PACKAGE / node).chmod(0o755)
    write(library / PACKAGE / "__init__.py", "")
    write(root / "install" / "setup.bash", "")
    write(root / "install" / "COLCON_IGNORE", "")
    return prefix


@pytest.fixture
def shell(root, monkeypatch):
    """A shell of IPython that knows `%%save`; everything that it changes outside is put back."""
    monkeypatch.setitem(sys.modules, "__main__", sys.modules["__main__"])
    for name in ("excepthook", "displayhook", "ps1", "ps2", "ps3"):
        if hasattr(sys, name):
            monkeypatch.setattr(sys, name, getattr(sys, name))
    settings = Config()
    settings.HistoryManager.enabled = False
    settings.InteractiveShell.colors = "NoColor" if sys.version_info < (3, 11) else "nocolor"
    settings.InteractiveShell.xmode = "Context"
    # The only one of the process: tracebacks ask for it to know the numbers of cells.
    shell = InteractiveShell.instance(config=settings)
    workspace.register(shell)
    yield shell
    InteractiveShell.clear_instance()
    shell.restore_sys_module_state()


@pytest.fixture
def home(tmp_path, monkeypatch):
    """A steady home: what terminals show names nobody and no machine."""
    folder = tmp_path / "home"
    folder.mkdir()
    monkeypatch.setenv("ROSBEAT_STEADY_HOME", str(folder))
    return folder


@pytest.fixture
def terminals(home):
    with Terminals() as opened:
        yield opened


@pytest.fixture
def terminal(terminals):
    return terminals.get("sensor")


@pytest.fixture
def seen(terminal):
    """Type into the terminal and return the lines that were shown."""

    def type_and_see(text, **options):
        shown = []
        terminal.type(text, show=shown.append, **options)
        return shown

    return type_and_see

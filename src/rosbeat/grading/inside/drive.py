"""A program of its own that runs a page in a kernel of Jupyter: `python drive.py PAGE`.

It imports nothing of this package, and it is a process of its own because the one that it comes
from was prepared for something else.
"""

from __future__ import annotations

import sys
from pathlib import Path

#: Exit code if the kernel has died.
DIED = 3
#: jsonschema takes it if it is there, to check addresses, and it needs seconds to be imported.
_SLOW = "rfc3987_syntax"


def main(page: Path) -> int:
    """Run all cells of a page; cells that raise stop nothing.

    Args:
        page: A notebook in the format 4.

    Returns:
        0, or `DIED`.
    """
    sys.modules[_SLOW] = None  # type: ignore[assignment]
    import nbformat
    from nbclient import NotebookClient
    from nbclient.exceptions import DeadKernelError
    from traitlets.config import Config

    # Sockets are files here; nobody else is in the sandbox who could find them.
    config = Config({"KernelManager": {"transport": "ipc"}})
    notebook = nbformat.read(page, as_version=4)
    client = NotebookClient(notebook, kernel_name="python3", allow_errors=True, config=config)
    try:
        client.execute()
    except DeadKernelError:
        print("the kernel has died")
        return DIED
    return 0


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1])))

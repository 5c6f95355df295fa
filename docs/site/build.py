"""Builds the site with Sphinx from its source, which `stage.py` has laid out, and shows it.

`./environment/course site` calls this file in an environment that has Sphinx
(`environment/site.in`).
"""

from __future__ import annotations

import argparse
import functools
import http.server
import subprocess
import sys
import tempfile
import webbrowser
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]


def build(source: Path, out: Path) -> int:
    """Build the site into a folder; return Sphinx's exit code. Every warning is an error."""
    with tempfile.TemporaryDirectory() as doctrees:
        command = [sys.executable, "-m", "sphinx", "-b", "html", "-W", "--keep-going", "-q"]
        return subprocess.call([*command, "-d", doctrees, str(source), str(out)])


def show(out: Path) -> None:
    """Serve a folder on localhost, open it in a browser, and wait for Ctrl+C."""
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(out))
    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler) as server:
        address = f"http://127.0.0.1:{server.server_port}/"
        print(f"The site is at {address}\nCtrl+C stops it.", flush=True)
        webbrowser.open(address)
        try:
            server.serve_forever()
        except KeyboardInterrupt:
            print()


def main() -> int:
    """Read the command line, build the site, and show it if asked to."""
    parser = argparse.ArgumentParser(prog="./environment/course site", description=__doc__)
    parser.add_argument("--source", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("folder", nargs="?", type=Path, default=ROOT / "dist" / "site",
                        help="where to (dist/site unless told)")  # fmt: skip
    parser.add_argument("--open", action="store_true", help="serve it on localhost and open it")
    options = parser.parse_args()
    code = build(options.source, options.folder)
    if code == 0:
        print(f"The site is in {options.folder}")
        if options.open:
            show(options.folder)
    return code


if __name__ == "__main__":
    sys.exit(main())

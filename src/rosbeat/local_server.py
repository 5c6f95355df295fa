"""Serve a page to the person at this computer, and to nobody else.

Only programs on this computer can reach the server, and only with the token in its address: it
listens on the loopback interface, rejects requests for another host (DNS rebinding) and requests
from other pages, and a page may load nothing from elsewhere.
"""

from __future__ import annotations

import hmac
import secrets
import sys
from collections.abc import Mapping
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from urllib.parse import urlsplit

__all__ = ["LocalHandler", "LocalServer", "new_nonce"]

#: Seconds that a browser may take for a request.
_PATIENCE = 30


class LocalServer(ThreadingHTTPServer):
    """Listen on the loopback interface, at an address that nobody can guess.

    Args:
        handler: Answers the requests.
        port: The port; 0 for any that is free.

    Raises:
        OSError: If the port is not free.
    """

    daemon_threads = True

    def __init__(self, handler: type[LocalHandler], port: int = 0) -> None:
        super().__init__(("127.0.0.1", port), handler)
        self.token = secrets.token_urlsafe(32)
        self.hosts = {f"{name}:{self.server_port}" for name in ("127.0.0.1", "localhost")}

    def handle_error(self, request: object, client_address: object) -> None:
        """Say nothing of a browser that has gone; whoever closes a page breaks nothing."""
        if not isinstance(sys.exc_info()[1], ConnectionError | TimeoutError):
            super().handle_error(request, client_address)  # type: ignore[arg-type]  # passed on

    @property
    def root(self) -> str:
        """Return the path of the first page."""
        return f"/{self.token}/"

    @property
    def url(self) -> str:
        """Return the address of the first page."""
        return f"http://127.0.0.1:{self.server_port}{self.root}"


class LocalHandler(BaseHTTPRequestHandler):
    """Answer requests that a page of this server has made."""

    server: LocalServer
    server_version, sys_version = "rosbeat", ""
    timeout = _PATIENCE

    def log_message(self, format: str, *args: object) -> None:
        """Print nothing: the address is secret."""

    def do_GET(self) -> None:
        """Answer whoever knows the address."""
        path = self._asked_for()
        if path is not None:
            self.get(path)

    def do_POST(self) -> None:
        """Take what whoever knows the address has sent."""
        path = self._asked_for()
        if path is not None:
            self.post(path)

    def get(self, path: str) -> None:
        """Send what a path behind the token stands for."""
        self.refuse(HTTPStatus.NOT_FOUND)

    def post(self, path: str) -> None:
        """Take what was sent to a path behind the token."""
        self.refuse(HTTPStatus.METHOD_NOT_ALLOWED)

    def _asked_for(self) -> str | None:
        """Return the path behind the token; None if the request was refused."""
        host, origin = self.headers.get("Host", ""), self.headers.get("Origin")
        elsewhere = origin is not None and origin not in {f"http://{host}"}
        if host not in self.server.hosts or elsewhere:
            self.refuse(HTTPStatus.FORBIDDEN)
            return None
        token, _, path = urlsplit(self.path).path.removeprefix("/").partition("/")
        if not hmac.compare_digest(token.encode(), self.server.token.encode()):
            self.refuse(HTTPStatus.NOT_FOUND)
            return None
        return path

    def send_page(
        self,
        page: str,
        nonce: str,
        status: HTTPStatus = HTTPStatus.OK,
        allowed: Mapping[str, str] | None = None,
    ) -> None:
        """Send HTML that runs no script and no style but its own.

        Args:
            page: The HTML.
            nonce: What its own style and script are known by.
            status: The status.
            allowed: What else the page may do, by the directive of its Content-Security-Policy.
        """
        own = f"'nonce-{nonce}'"
        policy = {"style-src": own, "script-src": own, "form-action": "'self'", **(allowed or {})}
        data = page.encode("utf-8", "backslashreplace")
        self.send(data, "text/html; charset=utf-8", policy, status)

    def send(
        self,
        data: bytes,
        kind: str,
        allowed: Mapping[str, str],
        status: HTTPStatus = HTTPStatus.OK,
    ) -> None:
        """Send a document that may do nothing but what is allowed.

        Args:
            data: The document.
            kind: Its media type.
            allowed: What it may do, by the directive of its Content-Security-Policy.
            status: The status.
        """
        closed = {"default-src": "'none'", "base-uri": "'none'", "frame-ancestors": "'none'"}
        policy = "; ".join(" ".join(one) for one in {**closed, **allowed}.items())
        self.send_response(status)
        for name, value in (
            ("Content-Type", kind),
            ("Content-Length", str(len(data))),
            ("Content-Security-Policy", policy),
            ("Cache-Control", "no-store"),
            # Without a referrer, a form of this page would say `Origin: null`, as a forger's does.
            ("Referrer-Policy", "same-origin"),
            ("X-Content-Type-Options", "nosniff"),
        ):
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(data)

    def refuse(self, status: HTTPStatus) -> None:
        """Send a status and nothing else."""
        self.send_response(status)
        self.send_header("Content-Length", "0")
        self.end_headers()


def new_nonce() -> str:
    """Return what a page's own style and script are known by, new for each page."""
    return secrets.token_urlsafe(16)

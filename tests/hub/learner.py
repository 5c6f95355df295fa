"""A learner as JupyterHub knows one: over HTTP and websockets only."""

from __future__ import annotations

import json
import time
from contextlib import contextmanager
from uuid import uuid4

import nbformat
import requests
import websocket
from nbformat.v4 import output_from_msg

from notebooks.comparison import comparable

#: Seconds of patience with one answer, and with a server, a kernel or a cell on a busy machine.
PATIENCE, LONG_PATIENCE = 60, 240
OUTPUTS = ("stream", "display_data", "execute_result", "error")


class Learner:
    """One who is logged in.

    Args:
        url: The hub's address, without a slash at the end.
        name: The user.
        password: Theirs.
    """

    def __init__(self, url, name, password):
        self.url, self.name = url, name
        self.http = requests.Session()
        self.http.trust_env = False
        self._log_in(password)

    def _log_in(self, password):
        page = self.http.get(f"{self.url}/hub/login", timeout=PATIENCE)
        page.raise_for_status()
        token = self.http.cookies.get("_xsrf", path="/hub/")
        form = {"username": self.name, "password": password, "_xsrf": token}
        # Not on to the server, which would be started by following.
        answer = self.http.post(
            f"{self.url}/hub/login", data=form, timeout=PATIENCE, allow_redirects=False
        )
        if answer.status_code != 302:
            raise PermissionError(f"{self.name}: {answer.status_code}")
        made = self.http.post(
            f"{self.url}/hub/api/users/{self.name}/tokens",
            params={"_xsrf": self.http.cookies.get("_xsrf", path="/hub/")}, timeout=PATIENCE,
            headers={"Referer": f"{self.url}/hub/token"},
        )  # fmt: skip
        made.raise_for_status()
        self.token = made.json()["token"]
        self.http.cookies.clear()
        self.http.headers["Authorization"] = f"token {self.token}"

    def hub(self, method, path):
        """What the hub's API answers."""
        return self.http.request(method, f"{self.url}/hub/api/{path}", timeout=PATIENCE)

    def ask(self, method, path, of="", **more):
        """What the API of a server answers: one's own, unless another learner is named."""
        address = f"{self.url}/user/{of or self.name}/api/{path}"
        return self.http.request(method, address, timeout=PATIENCE, **more)

    def start_server(self):
        """Start one's server, and wait until it answers."""
        self.hub("POST", f"users/{self.name}/server").raise_for_status()
        self._wait_for(lambda servers: servers.get("", {}).get("ready"))

    def stop_server(self):
        """Stop one's server, and wait until it has ended: another one starts only then."""
        self.hub("DELETE", f"users/{self.name}/server").raise_for_status()
        self._wait_for(lambda servers: not servers)

    def _wait_for(self, is_so):
        deadline = time.monotonic() + LONG_PATIENCE
        while not is_so(servers := self.hub("GET", f"users/{self.name}").json()["servers"]):
            if time.monotonic() > deadline:
                raise TimeoutError(f"{self.name}: {servers}")
            time.sleep(0.2)

    def page(self, name):
        """A notebook in one's folder."""
        answer = self.ask("GET", f"contents/{name}")
        answer.raise_for_status()
        return nbformat.from_dict(answer.json()["content"])

    def save(self, name, page):
        """Save a notebook, as JupyterLab does."""
        body = {"type": "notebook", "content": page}
        self.ask("PUT", f"contents/{name}", json=body).raise_for_status()

    @contextmanager
    def kernel(self, page):
        """Open a page: a kernel for it, until the end."""
        body = {"path": page, "name": page, "type": "notebook", "kernel": {"name": "python3"}}
        made = self.ask("POST", "sessions", json=body)
        made.raise_for_status()
        session = made.json()
        try:
            with self._socket(f"kernels/{session['kernel']['id']}/channels") as channel:
                yield Kernel(channel, session["kernel"]["id"])
        finally:
            self.ask("DELETE", f"sessions/{session['id']}")

    @contextmanager
    def terminal(self):
        """Open a terminal."""
        name = self.ask("POST", "terminals").json()["name"]
        address = f"{self.url}/user/{self.name}/terminals/websocket/{name}"
        try:
            with self._connected(address) as socket:
                yield Terminal(socket)
        finally:
            self.ask("DELETE", f"terminals/{name}")

    def _socket(self, path):
        return self._connected(f"{self.url}/user/{self.name}/api/{path}")

    @contextmanager
    def _connected(self, address):
        socket = websocket.create_connection(
            address.replace("http", "ws", 1), timeout=LONG_PATIENCE,
            header=[f"Authorization: token {self.token}"],
        )  # fmt: skip
        try:
            yield socket
        finally:
            socket.close()


class KernelDiedError(Exception):
    """A kernel ended while it ran a cell."""


class Kernel:
    """A kernel, by its websocket.

    Args:
        socket: The websocket.
        number: The kernel's id.
    """

    def __init__(self, socket, number):
        self.socket, self.id = socket, number

    def run(self, code):
        """Run a cell; its outputs, as nbformat has them, and how it ended."""
        asked = uuid4().hex
        header = {"msg_id": asked, "msg_type": "execute_request", "username": "", "version": "5.3",
                  "session": "test", "date": ""}  # fmt: skip
        content = {"code": code, "silent": False, "store_history": True, "user_expressions": {},
                   "allow_stdin": False, "stop_on_error": False}  # fmt: skip
        self.socket.send(
            json.dumps({"header": header, "parent_header": {}, "metadata": {}, "content": content,
                        "channel": "shell", "buffers": []})
        )  # fmt: skip
        outputs, status = [], ""
        idle = False
        while not (idle and status):
            message = json.loads(self.socket.recv())
            kind = message["msg_type"]
            state = message["content"].get("execution_state")
            if kind == "status" and state in ("restarting", "autorestarting", "dead"):
                raise KernelDiedError(state)
            if message["parent_header"].get("msg_id") != asked:
                continue
            if kind in OUTPUTS:
                outputs.append(output_from_msg(message))
            elif kind == "execute_reply":
                status = message["content"]["status"]
            elif kind == "status":
                idle = state == "idle"
        return outputs, status

    def died(self, code):
        """Whether the kernel dies of a cell: Jupyter's server says that it restarts."""
        try:
            self.run(code)
        except KernelDiedError:
            return True
        return False

    def says(self, code):
        """Run a cell that prints; what it printed."""
        outputs, status = self.run(code)
        text = "".join(one.get("text", one.get("evalue", "")) for one in outputs)
        if status != "ok":
            raise RuntimeError(text)
        return text


class Terminal:
    """A terminal, by its websocket.

    Args:
        socket: The websocket.
    """

    def __init__(self, socket):
        self.socket = socket

    def run(self, command):
        """Run a command; what it wrote."""
        mark = uuid4().hex
        # The terminal echoes what is typed: there, the mark is in two parts.
        typed = f"{command}; echo {mark[:16]}''{mark[16:]}\r"
        self.socket.send(json.dumps(["stdin", typed]))
        seen = ""
        while mark not in seen:
            kind, *rest = json.loads(self.socket.recv())
            seen += rest[0] if kind == "stdout" else ""
        return seen.partition(mark)[0]


def as_compared(outputs):
    """Outputs as they are compared: streams joined, pictures only known to be there."""
    joined = []
    for one in comparable(outputs):
        last = joined[-1] if joined else {}
        if one.output_type == "stream" == last.get("output_type") and one.name == last["name"]:
            last["text"] += one.text
        else:
            joined.append(one)
    for one in joined:
        one.pop("execution_count", None)
        one.pop("metadata", None)
    return joined

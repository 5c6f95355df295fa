"""Serve a local page in the process of a test."""

import threading
from contextlib import contextmanager


@contextmanager
def serving(server):
    """Serve until the test is done; the server is closed then."""
    with server:
        # Asked to stop, it notices at once; half a second later would be soon enough for a person.
        thread = threading.Thread(target=server.serve_forever, kwargs={"poll_interval": 0.005})
        thread.start()
        try:
            yield server
        finally:
            server.shutdown()
            thread.join()

"""A server for one page, on this machine alone; it can be read and not written to."""

from __future__ import annotations

import json
import threading
from http import HTTPStatus
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from importlib.resources import files
from typing import Any

from forgetting.stream.live.events import Events
from forgetting.words.errors import RecordError

ADDRESS = "127.0.0.1"
PORT = 8470
NAMES = ("127.0.0.1", "localhost")
"""Names by which a browser may ask: any other is a page of somebody else's that found the port."""
BEAT = 5.0
"""Seconds after which a page hears that there is nothing new; one that left is noticed then."""
MOST = 16
"""Pages that may listen at a time."""
FOLDER = files(__package__)
FILES = {
    "/": ("page.html", "text/html; charset=utf-8"),
    "/page.css": ("page.css", "text/css; charset=utf-8"),
    "/page.js": ("page.js", "text/javascript; charset=utf-8"),
    "/uplot/uPlot.iife.min.js": ("uplot/uPlot.iife.min.js", "text/javascript; charset=utf-8"),
    "/uplot/uPlot.min.css": ("uplot/uPlot.min.css", "text/css; charset=utf-8"),
}
HEADERS = {
    "Cache-Control": "no-store",
    "Content-Security-Policy": "default-src 'self'; style-src 'self' 'unsafe-inline'; "
    "frame-ancestors 'none'; base-uri 'none'; form-action 'none'",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


class Handler(BaseHTTPRequestHandler):
    """Answers GET for the page, its files, and its events."""

    server: Server
    server_version = "forgetting"
    sys_version = ""
    timeout = 30

    def do_GET(self) -> None:
        """Send a file or the events."""
        if not self._is_ours():
            self.send_error(HTTPStatus.FORBIDDEN, "this page is for this machine alone")
        elif self.path == "/events":
            self._events()
        elif self.path in FILES:
            name, kind = FILES[self.path]
            self._send(FOLDER.joinpath(name).read_bytes(), kind)
        else:
            self.send_error(HTTPStatus.NOT_FOUND)

    def _is_ours(self) -> bool:
        """Whether the browser asked for this machine by its own name."""
        host = (self.headers.get("Host") or "").lower()
        return host in {f"{name}:{self.server.server_port}" for name in NAMES}

    def _send(self, content: bytes, kind: str) -> None:
        self._begin(kind)
        self.send_header("Content-Length", str(len(content)))
        self.end_headers()
        self.wfile.write(content)

    def _begin(self, kind: str) -> None:
        self.send_response(HTTPStatus.OK)
        self.send_header("Content-Type", kind)
        for name, value in HEADERS.items():
            self.send_header(name, value)

    def _events(self) -> None:
        if not self.server.enter():
            self.send_error(HTTPStatus.SERVICE_UNAVAILABLE, "too many pages are open")
            return
        try:
            self._begin("text/event-stream")
            self.end_headers()
            self._tell()
        except OSError:
            # The page was closed.
            pass
        finally:
            self.server.leave()

    def _tell(self) -> None:
        events, count, begun = self.server.events, 0, False
        while not self.server.ended:
            found = events.after(count, BEAT)
            if found and not begun:
                self._write("begin", json.dumps(events.beginning(found[0][0])))
                begun = True
            for _, text in found:
                self._write("row", text)
            count = found[-1][0] if found else count
            if not found:
                self.wfile.write(b": nothing new\n\n")
            self.wfile.flush()

    def _write(self, kind: str, text: str) -> None:
        self.wfile.write(f"event: {kind}\ndata: {text}\n\n".encode())

    def log_message(self, format: str, *args: Any) -> None:
        """Requests are no news for who watches the command."""


class Server(ThreadingHTTPServer):
    """Serves the page in threads of its own.

    Parameters
    ----------
    events : Events
    port : int
        0 for any that is free.

    Raises
    ------
    RecordError
        When the port is taken.
    """

    daemon_threads = True
    block_on_close = False
    allow_reuse_address = True

    def __init__(self, events: Events, port: int = PORT) -> None:
        self.events = events
        self.pages = 0
        """Pages that listen."""
        self.counting = threading.Lock()
        self.ended = False
        try:
            super().__init__((ADDRESS, port), Handler)
        except OSError as error:
            raise RecordError(
                f"port {port} of this machine cannot be had: {error.strerror}; --port names another"
            ) from None

    def enter(self) -> bool:
        """Count a page that listens, unless there are too many."""
        with self.counting:
            if self.pages >= MOST:
                return False
            self.pages += 1
            return True

    def leave(self) -> None:
        """One page less."""
        with self.counting:
            self.pages -= 1

    @property
    def address(self) -> str:
        """Where the page is."""
        return f"http://{ADDRESS}:{self.server_port}/"

    def start(self) -> None:
        """Serve from now on."""
        threading.Thread(target=self.serve_forever, daemon=True).start()

    def stop(self) -> None:
        """Serve no longer."""
        self.ended = True
        with self.events.news:
            self.events.news.notify_all()
        self.shutdown()
        self.server_close()

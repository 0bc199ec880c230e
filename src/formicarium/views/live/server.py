"""Serves the page of one trial: a few files known beforehand and one WebSocket. It never reads a path from a request.

Every page has its own place in the stream: it is sent the latest picture when the last one has gone out, so a slow
page sees fewer pictures and nobody waits for it.
"""

import asyncio
import contextlib
import errno
import ipaddress
import socket
from collections.abc import AsyncIterator, Callable
from typing import Any

import numpy as np
import uvicorn
from pydantic import ValidationError
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import PlainTextResponse, Response
from starlette.routing import Route, WebSocketRoute
from starlette.types import ASGIApp, Receive, Scope, Send
from starlette.websockets import WebSocket, WebSocketDisconnect

from formicarium.views.live.player import Player
from formicarium.views.live.wire import said, wish_of
from formicarium.views.page import page_files

MOST_BYTES = 16_384  # of a message from a page
MOST_PAGES = 64
EVENTS_AT_ONCE = 400
MISTAKES = 20  # malformed messages after which a page is shown the door
SEND_PATIENCE = 20.0  # s; a page that takes nothing for so long is gone


class PortTaken(Exception):
    """The port cannot be listened on; says why and what to do."""


def listening(host: str, port: int) -> socket.socket:
    """Return a socket that listens.

    Raises:
        PortTaken: if it cannot.
    """
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    found = socket.socket(family, socket.SOCK_STREAM)
    found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    try:
        found.bind((host, port))
        found.listen(64)
    except OSError as error:
        found.close()
        if error.errno == errno.EADDRINUSE:
            raise PortTaken(
                f"port {port} of {host} is taken by another program. Choose another with --port, "
                "or --port 0 for any that is free."
            ) from error
        raise PortTaken(f"cannot listen on {host}, port {port}: {error.strerror or error}") from error
    return found


class Doorkeeper:
    """Turns away requests that name another host or come from another page's origin."""

    def __init__(self, app: ASGIApp, host: str):
        """Guard ``app``, which listens on ``host``."""
        self._app = app
        self._names = {"localhost", host.lower()}
        if host not in ("127.0.0.1", "::1", "localhost"):
            self._names.add(socket.gethostname().lower())  # others reach this machine by its name

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Let a request through, or refuse it."""
        if scope["type"] in ("http", "websocket") and not self._welcome(scope):
            if scope["type"] == "websocket":
                await send({"type": "websocket.close", "code": 1008})
            else:
                await PlainTextResponse("wrong host or origin\n", 403)(scope, receive, send)
            return
        await self._app(scope, receive, send)

    def _welcome(self, scope: Scope) -> bool:
        headers = {name: value.decode("latin-1").lower() for name, value in scope["headers"]}
        host, origin = headers.get(b"host", ""), headers.get(b"origin")
        return self._known(host) and (origin is None or origin == f"http://{host}")

    def _known(self, host: str) -> bool:
        # A name that anybody can point at this machine is refused; an address cannot be pointed elsewhere.
        name = host.rsplit(":", 1)[0] if not host.endswith("]") else host
        if name in self._names:
            return True
        try:
            ipaddress.ip_address(name.strip("[]"))
        except ValueError:
            return False
        return True


class Audience:
    """All pages that look at one player."""

    def __init__(self, player: Player, hello: dict[str, Any], tell: Callable[[Any], str], kinds: tuple[str, ...]):
        """Get ready for pages.

        Args:
            player: what they look at.
            hello: what a page is told first.
            tell: event -> sentence.
            kinds: names of the event kinds.
        """
        self.player, self._hello, self._tell, self._kinds = player, hello, tell, kinds
        self._pages: dict[int, asyncio.Event] = {}
        self._came = 0

    @contextlib.asynccontextmanager
    async def open(self, _: Starlette) -> AsyncIterator[None]:
        """Play while the server runs."""
        loop = asyncio.get_running_loop()

        def told() -> None:
            loop.call_soon_threadsafe(self._wake)

        self.player.audience = told
        self.player.thread.start()
        try:
            yield
        finally:
            await asyncio.to_thread(self.player.stop)

    def _wake(self) -> None:
        for news in self._pages.values():
            news.set()

    async def page(self, connection: WebSocket) -> None:
        """Look after one page until it goes."""
        if len(self._pages) >= MOST_PAGES:
            await connection.close(1013)
            return
        await connection.accept()
        self._came += 1
        page, news = self._came, asyncio.Event()
        self._pages[page] = news
        self.player.watched = True
        self.player.refresh()
        tasks = [
            asyncio.create_task(self._talk(page, connection, news)),
            asyncio.create_task(self._hear(page, connection)),
        ]
        try:
            await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
        finally:
            for task in tasks:
                task.cancel()
            await asyncio.gather(*tasks, return_exceptions=True)
            del self._pages[page]
            self.player.watched = bool(self._pages)
            self.player.leave(page)
            with contextlib.suppress(Exception):
                await connection.close()

    async def _hear(self, page: int, connection: WebSocket) -> None:
        mistakes = 0
        with contextlib.suppress(WebSocketDisconnect, RuntimeError):
            while mistakes < MISTAKES:
                message = await connection.receive()
                if message["type"] == "websocket.disconnect":
                    return
                try:
                    self.player.ask(page, wish_of(message.get("text") or ""))
                except ValidationError:
                    mistakes += 1
                    await connection.send_text(said("notice", text="that message made no sense"))

    async def _talk(self, page: int, connection: WebSocket, news: asyncio.Event) -> None:
        async def send(message: str | bytes) -> None:
            sending = connection.send_text(message) if isinstance(message, str) else connection.send_bytes(message)
            # Not wait_for: in Python 3.11 it can swallow the cancelling of this task, and the page would stay for ever.
            async with asyncio.timeout(SEND_PATIENCE):
                await sending

        with contextlib.suppress(WebSocketDisconnect, RuntimeError, TimeoutError, OSError):
            await send(said("hello", **self._hello))
            told, logs, noticed, status, inspected = 0, None, 0, "", None
            while True:
                shown = self.player.shown
                session = self.player.session
                await send(shown.frame)
                if shown.status != status:
                    status = shown.status
                    await send(status)
                if session.logs is not logs:  # the first time, and when the trial has taken another turn
                    logs, told = session.logs, 0
                    await send(said("events", again=True, rows=[]))
                told = await self._tell_events(send, logs, told)
                if shown.notice[0] > noticed:
                    noticed = shown.notice[0]
                    await send(said("notice", text=shown.notice[1]))
                mine = self.player.inspections.get(self.player.selected.get(page, 0))
                if mine is not None and mine != inspected:
                    inspected = mine
                    await send(mine[1])
                if self.player.shown is shown:
                    await news.wait()
                news.clear()

    async def _tell_events(self, send: Callable[[str], Any], logs: list[np.ndarray], told: int) -> int:
        """Send the logs after the first ``told``; return how many there are now."""
        count = len(logs)
        rows = [
            [int(event["cycle"]), self._kinds[int(event["kind"])], int(event["robot"]), self._tell(event)]
            for log in logs[told:count]
            for event in log
        ]
        for first in range(0, len(rows), EVENTS_AT_ONCE):
            await send(said("events", again=False, rows=rows[first : first + EVENTS_AT_ONCE]))
        return count


def application(audience: Audience, host: str, title: str) -> Starlette:
    """Return the application: the page, its files, the socket, and nothing else."""
    files = page_files(title)

    def serve(request: Request) -> Response:
        content, kind = files[request.url.path]
        headers = {
            "Content-Security-Policy": "default-src 'none'; script-src 'self'; style-src 'self' 'unsafe-inline'; "
            "img-src 'self' data:; connect-src 'self'; base-uri 'none'; frame-ancestors 'none'",
            "X-Content-Type-Options": "nosniff",
            "Cache-Control": "no-store",
        }
        return Response(content, media_type=kind, headers=headers)

    routes = [Route(path, serve, methods=["GET"]) for path in files]
    app = Starlette(routes=[*routes, WebSocketRoute("/socket", audience.page)], lifespan=audience.open)
    app.add_middleware(Doorkeeper, host=host)
    return app


def serve(audience: Audience, listener: socket.socket, host: str, title: str, ready: Callable[[], None]) -> None:
    """Serve until Ctrl-C or until the trial breaks; the trial's thread has ended when this returns."""
    configuration = uvicorn.Config(
        application(audience, host, title),
        log_level="error",
        ws_max_size=MOST_BYTES,
        ws_per_message_deflate=False,
        timeout_graceful_shutdown=2,
    )
    server = uvicorn.Server(configuration)
    original = server.startup

    async def startup(sockets: list[socket.socket] | None = None) -> None:
        await original(sockets)
        ready()

    server.startup = startup  # type: ignore[method-assign]
    with contextlib.suppress(KeyboardInterrupt):
        server.run(sockets=[listener])

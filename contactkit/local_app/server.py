"""Server of the app: on this machine only, with a token, and nothing fetched from elsewhere."""

from __future__ import annotations

import inspect
import secrets
import shutil
import socket
from collections.abc import Awaitable, Callable, Iterator, MutableMapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from attrs import field, frozen

from ..errors import DescriptionError
from ..extras import require
from .desk import HALVES, Desk, opened_scene, put_on_desk

__all__ = ["HOST", "LocalServer", "local_server"]

HOST = "127.0.0.1"
"""Address that the server listens on: no other machine reaches it."""

_Message = MutableMapping[str, Any]
_Asgi = Callable[[_Message, Callable[[], Awaitable[Any]], Callable[[Any], Awaitable[None]]], Any]

# marimo's page may ask its own server and nobody else, and no other page may frame it.
_POLICY = (
    "default-src 'self'; script-src 'self' 'unsafe-inline' 'unsafe-eval' blob:; "
    "style-src 'self' 'unsafe-inline'; img-src 'self' data: blob:; font-src 'self' data:; "
    "worker-src 'self' blob:; connect-src 'self' data: blob: ws://{host}; frame-ancestors 'none'"
)


@frozen
class LocalServer:
    """A server that listens already: its address with the token, and `run`, until it is ended."""

    address: str
    desk: Desk
    _server: Any = field(repr=False)
    _socket: socket.socket = field(repr=False)

    def run(self) -> None:
        """Serve until SIGINT or SIGTERM."""
        self._server.run(sockets=[self._socket])


@contextmanager
def local_server(opened: Path | str | None = None, port: int = 0) -> Iterator[LocalServer]:
    """Make a server of the app; its folder of uploads goes with it.

    Parameters
    ----------
    opened : path or str, optional
        A scene, or a height map, that the app begins with.
    port : int
        Port on this machine; 0: a free one.

    Raises
    ------
    MissingExtraError
        If marimo is not installed.
    ContactkitError
        If the port is taken, or what is opened holds neither a contact nor a separation.
    """
    require("marimo", "the app")
    if opened is not None:
        opened_scene(opened, HALVES[0])
    listening = _listening(port)
    desk = put_on_desk(opened)
    token = secrets.token_urlsafe(24)
    host = f"{HOST}:{listening.getsockname()[1]}"
    try:
        server = _uvicorn(_guarded(_application(desk, token), host))
        yield LocalServer(f"http://{host}/?access_token={token}", desk, server, listening)
    finally:
        listening.close()
        desk.close()


def _listening(port: int) -> socket.socket:
    try:
        return socket.create_server((HOST, port))
    except (OSError, OverflowError) as error:
        hint = f"{getattr(error, 'strerror', None) or error}; leave --port out for a free one"
        raise DescriptionError("--port", port, "be a free port", hint=hint) from None


def _application(desk: Desk, token: str) -> _Asgi:
    """The notebook as an application; from a copy, as marimo may write beside a notebook."""
    import marimo

    notebook = desk.folder / "app" / "notebook.py"
    notebook.parent.mkdir()
    shutil.copyfile(Path(__file__).with_name("notebook.py"), notebook)
    builder = marimo.create_asgi_app(quiet=True, token=token, session_ttl=600)
    made: _Asgi = builder.with_app(path="/", root=str(notebook)).build()
    return made


def _guarded(application: _Asgi, host: str) -> _Asgi:
    """Refuse requests of other pages, also by names rebound to this host; set the policy."""
    hosts = (host, host.replace(HOST, "localhost"))
    names = {name.encode() for name in hosts}
    origins = {None, *(f"http://{name}".encode() for name in hosts)}
    policy = _POLICY.format(host=host)
    headers = [
        (b"content-security-policy", policy.encode()),
        (b"referrer-policy", b"no-referrer"),
        (b"x-content-type-options", b"nosniff"),
    ]

    async def guarded(scope: _Message, receive: Any, send: Any) -> None:
        if scope["type"] not in ("http", "websocket"):
            await application(scope, _closing(application, receive), send)
            return
        given = dict(scope["headers"])
        if given.get(b"host") not in names or given.get(b"origin") not in origins:
            await _refuse(scope, send)
            return

        async def with_policy(message: Any) -> None:
            if message["type"] == "http.response.start":
                message["headers"] = [*message.get("headers", ()), *headers]
            await send(message)

        await application(scope, receive, with_policy)

    return guarded


def _closing(application: Any, receive: Callable[[], Awaitable[Any]]) -> Any:
    """Messages of the server, at whose end the sessions are closed.

    marimo leaves that to the lifespan of an application, which a mounted one does not have: a
    thread would wait for the next request of each page for ever, and Python for the thread.
    """

    async def received() -> Any:
        message = await receive()
        if message["type"] == "lifespan.shutdown":
            for route in getattr(application, "routes", ()):
                state = getattr(getattr(route, "app", None), "state", None)
                manager = getattr(state, "session_manager", None)
                closed = manager.shutdown() if manager is not None else None
                if inspect.isawaitable(closed):
                    await closed
        return message

    return received


async def _refuse(scope: _Message, send: Any) -> None:
    if scope["type"] == "websocket":
        await send({"type": "websocket.close", "code": 1008})
        return
    await send({"type": "http.response.start", "status": 421, "headers": []})
    await send({"type": "http.response.body", "body": b"This server answers to its own name only."})


def _uvicorn(application: _Asgi) -> Any:
    import uvicorn

    return uvicorn.Server(
        uvicorn.Config(application, log_level="error", timeout_graceful_shutdown=2)
    )

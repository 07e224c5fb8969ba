"""``contactkit app``."""

from __future__ import annotations

import webbrowser

import click

from . import options
from .terminal import say

__all__ = ["SCENES", "app"]


SCENES = ("contact-stop", "head-disk", "tip-landing")
"""Scenes of contactkit that the app takes: those that are no device."""


@click.command(cls=options.Command)
@click.argument("scene", metavar="[SCENE|MAP]", required=False, type=options.Names(lambda: SCENES))
@click.option("--port", type=int, default=0, help="Port on this machine; else a free one.")
@click.option("--no-browser", is_flag=True, help="Print the address only.")
def app(scene: str | None, port: int, no_browser: bool) -> None:
    """Open the local app in a browser.

    It begins with SCENE, a contact or a separation, or with a height MAP. It answers to this
    machine only, and ends with Ctrl-C; needs the extra app.
    """
    from ..local_app.server import local_server

    with local_server(scene, port) as server:
        say(f"{server.address}\nCtrl-C ends it.")
        if not no_browser:
            webbrowser.open(server.address)
        try:
            server.run()
        except KeyboardInterrupt as ended:  # once every request is answered
            if type(ended) is not KeyboardInterrupt:
                raise  # SIGTERM, which has an exit status of its own
        say("closed")  # also where SIGINT was ignored at the start: nothing is raised then

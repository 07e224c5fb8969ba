"""The command ``contactkit``, and the commands below it."""

from __future__ import annotations

import click

from .app import app
from .cite import cite
from .completion import completion
from .cost import cost
from .fit import fit
from .fmu import fmu
from .gallery import gallery
from .lists import list_names, new, schema
from .options import Group
from .page import page
from .plan import check, plan
from .report import report
from .run import run
from .study import study

__all__ = ["contactkit"]


@click.group(
    cls=Group,
    invoke_without_command=True,
    context_settings={"max_content_width": 100},
)
@click.option("--version", is_flag=True, help="Print the version and exit.")
@click.pass_context
def contactkit(context: click.Context, version: bool) -> int:
    """Contact of rough layered surfaces, and the forces that resist separating wetted ones."""
    if version:
        from .._version import __version__

        click.echo(__version__)
        return 0
    if context.invoked_subcommand is None:
        click.echo(context.get_help())
        return 2
    return 0


for _command in (
    *(list_names, new, check, plan, cite, run, study, fit, cost, report, page),
    *(app, gallery, fmu, schema, completion),
):
    contactkit.add_command(_command)

"""Commands of the command line, one to a module.

group           The command ``contactkit``, and the commands below it.
options         Arguments and options that several commands take, with their completion.
terminal        Printing of results, remarks, progress and times, as much as is asked for.
work            Runs of a scene: its output folder, its progress, its report.
run             ``contactkit run``.
study           ``contactkit study``.
fit             ``contactkit fit``.
plan            ``contactkit plan`` and ``contactkit check``, which run nothing.
cost            ``contactkit cost``.
cite            ``contactkit cite``.
report          ``contactkit report``.
page            ``contactkit page``.
app             ``contactkit app``.
gallery         ``contactkit gallery``.
lists           ``contactkit list``, ``new`` and ``schema``, which help to write a scene file.
fmu             ``contactkit fmu build``, ``fmu system``, ``fmu modelica`` and ``fmu crosscheck``.
completion      ``contactkit completion``.
"""

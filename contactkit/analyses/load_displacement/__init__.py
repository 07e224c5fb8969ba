"""Load-displacement curve of a rough contact: loading, unloading after yield, impact.

curve   The force of a rough contact over its approach, as tables that need no numpy.
impact  A body that meets an end stop: the stop in series with the bodies behind it, and one blow.
solve   The load-approach curve of a rough contact: what an end stop pushes back with, out and in.
"""

"""Rough faces of an end stop.

faces  The faces of a stop, as the file of a device names them; solved by `stop_solve`.
solve  Curve of the faces of a stop that a device file names: the contact is solved once, then kept.
"""

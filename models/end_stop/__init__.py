"""Rough faces of an end stop.

faces  Rough end-stop faces, as the file of a device names them; solved by `end_stop.solve`.
solve  Load-displacement curve of the faces of an end stop: the contact is solved once, then kept.
"""

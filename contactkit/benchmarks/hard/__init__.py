"""Hard cases: where a plain method loses all digits, never ends, or has no answer.

case      A hard case: why it is hard, a naive method, ours, and the errors of both.
cases     Table of the hard cases.
layers    Layered solids: thick layers, incompressible and stiff films.
contacts  Rough contacts: all pixels, hardness, offsets, edges, adhesion.
films     Films in motion: stiff films, small openings, thin lenses.
bridges   Liquid bridges: right angles, rupture, pinned contact lines.
"""

"""The C kernel of native FMUs.

cavities  The cavity of a film between flats in C: its memory, edge, force, events and paths.
tips      The tips of ``tip-contact`` in C: their motion, flight and impacts.
"""

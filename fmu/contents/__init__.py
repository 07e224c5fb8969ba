"""The files inside an FMU beside its model: documentation, icon, terminals, archive.

document   The documentation that travels in an FMU: what it is, its variables as a page, the licenc
end_stop   Load-displacement tables of an end stop.
icon       The icon of an FMU, as PNG and SVG.
packing    Zip archives whose bytes depend on their content alone.
ssp        System structures (SSP 1.0): which FMUs there are, how they are connected, their values.
terminals  What an FMU holds for tools that draw and connect: its flange as a terminal, and its icon
"""

"""The files inside an FMU beside its model: documentation, icon, terminals, archive.

document         The documentation that travels in an FMU: what it is, its variables as a page, the
                 licences.
end_stop         Load-displacement tables of an end stop, which an FMU carries beside its start
                 values.
icon             The icon of an FMU: a liquid film between two bodies, one of them pulled; as PNG
                 and SVG.
packing          Zip archives whose bytes depend on their content alone.
references       Reference results inside an FMU, as the layered standard FMI-LS-REF 1.0.0-beta.1
                 has them.
reference_check  Check of an FMU against the reference results inside it (FMI-LS-REF).
ssp              System structures (SSP 1.0): which FMUs there are, how they are connected, their
                 values.
terminals        Terminals and icon of an FMU, for tools that draw and connect.
"""

"""The FMU face of contactkit: ports, slaves and packaging; no formula lives here.

``ports`` describes the variables of an FMU and needs nothing but attrs, ``slave`` turns them
into an FMI 2.0 co-simulation slave on top of pythonfmu, ``build`` writes the FMU file. Nothing
is imported here, so that a plot can read a ports table without pythonfmu being installed.
"""

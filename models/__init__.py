"""Devices that contactkit comes with: equations of motion, and their scenes as files.

injector        Fuel injector: its file, coil, valve and monolithic model.
micromirror     Digital micromirror: electrostatics, spring tips, landing and release.
head_disk       Head-disk interface: its scene.
end_stop        Rough faces of an end stop.
liquid_bridges  Liquid bridges whose closures are compared.
device          Base class of devices, and of the reports that run them.
library         Scenes and kinds of devices by name.
ode_events      Events of scipy's solvers, and slopes by differences, for monolithic models.
"""

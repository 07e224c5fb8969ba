"""FMI: description, contents and packaging of FMUs, and a master; no formula of physics.

framework  FMI variables, model description, access and state of an FMU.
slaves     The models inside FMUs: their ports, and a plan stepped behind them.
python     FMUs that run in Python: build, carried modules, integrity.
native     Native FMUs: one C kernel for all models, and the tables of one scene.
modelica   Modelica wrappers of FMUs, with flanges of the standard library.
contents   Files inside an FMU beside its model: documentation, icon, terminals, archive.
master     Co-simulation of a film with a device.
"""

"""Co-simulation of a film with a device.

adaptive      The way of the master: steps chosen by their error, cut at events, to the gap or time
couple        The master for a tool that owns the mass: couples it to the FMU ``stiction-force``.
fixed         Fixed communication steps: what most masters do, and where it is refused.
force_step    One step of the master where a limit of the liquid may act: forces, implicit, of fifth
impulse_step  One step of the master: the mass on one side, the impulse of the film on the other.
injector      The master: couples the FMUs ``valve-drive`` and ``stiction-mass`` through fmpy.
sides         The two sides of the master's interface: a film that can be tried, and what pulls the
stage_root    The gap at which a stage of the master ends: Newton in ln h, with the film's own law.
"""

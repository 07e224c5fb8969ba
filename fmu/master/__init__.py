"""Co-simulation of a film with a device.

adaptive      Adaptive communication steps of a coupled run, cut at events, up to a gap or a time.
couple        The master for a tool that owns the mass: couples it to the FMU ``stiction-force``.
fixed         Fixed communication steps: what most masters do, and where it is refused.
force_step    One step of the master where a limit of the liquid may act: forces, implicit, of
              fifth order.
impulse_step  One step of the master: the mass on one side, the impulse of the film on the other.
injector      The master: couples the FMUs ``valve-drive`` and ``stiction-mass`` through fmpy.
steps         Communication steps: adaptive, or fixed with a coupling scheme.
sides         The coupled subsystems of a run: a film that can be tried, and the source of the pull.
stage_root    The gap at which a stage of the master ends: Newton in ln h, with the film's own law.
"""

"""The FMUs: stiction-mass, stiction-force, valve-drive, contact-stop, tip-contact.

contact_stop    The FMU ``contact-stop``: rough faces that meet at an end stop; gap in, force out.
deforming       The variables of ``deforming-mass`` and ``deforming-force``: films between bodies
                that deform.
film_travel     Impulses of a film over a change of its gap, and the time of its rupture.
moving_travel   The same of a film whose force, end or volume depends on the speed.
rheology        Rheology of the liquid and its slip, and the parameters that stand for them.
tension         Tension limit of a scene, and the parameters that stand for it.
wetting         Dynamic wetting of a scene, and the parameters that stand for it.
stiction_force  The FMU ``stiction-force``: a liquid film for a tool that owns the mass; motion in,
                force out.
stiction_mass   The FMU ``stiction-mass``: a mass held by a liquid film; a force in, motion out.
tip_contact     The FMU ``tip-contact``: spring tips on a landing site; motion of their root in,
                force out.
valve_drive     The FMU ``valve-drive``: coil, return spring and opposite stop of a spool valve.
"""

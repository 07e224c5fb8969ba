"""The digital micromirror: electrostatics, tips, landing and release.

coupling           Mirror and tips, coupled step by step: the mirror here, each side's tips wherever
electrostatics     Torque of a flat electrode on a tilting plate: closed forms that do not cancel.
flight             A free spring tip about a root that is steadily accelerated: its swing, and where
landing            How hard a spring tip lands on its site, and whether its apex bounces.
mirror             A torsional micromirror: hinge, electrodes, spring tips that land, and its voltag
monolithic         Monolithic model of mirror, tips and films.
release            Whether a micromirror lets go: by the spring alone, or by the smallest reset puls
scene              What the file of a micromirror says: one tip and its film, the mirror, what it is
tip                One spring tip between a moving root and its landing site: a mass, a spring, a fi
tip_film           What holds a spring tip: the liquid that condenses under it, and the law of its s
tip_impact         A spring tip on a site that gives: the blow of its apex, step by step, and how it
"""

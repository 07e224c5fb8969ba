"""The digital micromirror: electrostatics, spring tips, landing and release.

scene           Scene of a micromirror: one tip and its film, the mirror, settings of its runs.
mirror          A torsional micromirror: hinge, electrodes, spring tips that land, and its voltages.
electrostatics  Torque of a flat electrode on a tilting plate: closed forms that do not cancel.
tip             One spring tip between a moving root and its landing site: a mass, a spring, a film.
tip_film        Adhesion of a spring tip: the liquid that condenses under it, and the law of its
                separation.
tip_impact      Impact of a spring tip on a deformable landing site: stepped in time, then at rest
                in contact.
flight          A free spring tip about a root that is steadily accelerated: its swing, and where
                it lands.
landing         Landing of a spring tip on its site: force, dissipated work and rebound.
release         Release of a micromirror: by the spring alone, or by the smallest reset pulse.
report          Running the micromirror from the command line.
assumptions     Plausible ranges of what is assumed about the micromirror, with reasons.
coupling        Mirror and tips, coupled step by step: the mirror here, each side's tips wherever
                they live.
monolithic      Monolithic model of mirror, tips and films, by another method than their
                co-simulation.
"""

"""The digital micromirror: electrostatics, spring tips, landing and release.

scene           The file of a micromirror: one tip and its film, the mirror, the humidities.
mirror          A torsional micromirror: hinge, electrodes, spring tips, voltages over time.
electrostatics  Torque of a flat electrode on a tilting plate.
tip             One spring tip between a moving root and its landing site.
tip_film        The condensed liquid under a tip, and the force law of its film.
tip_impact      Impact of a spring tip on a deformable landing site.
flight          A free spring tip whose root is steadily accelerated.
landing         How hard a spring tip lands on its site, and whether its apex rebounds.
release         Release by the spring alone, or by the smallest reset pulse.
coupling        Co-simulation of mirror and tips, step by step.
monolithic      Monolithic model of mirror, tips and films.
"""

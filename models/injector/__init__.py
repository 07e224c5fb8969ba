"""The fuel injector: its file, coil, valve and monolithic model.

scene       The file of a fuel injector: film and spool, the valve that pulls, and what they are
            run at.
coil        An electromagnet with two poles and a moving armature: flux, current, force and energy.
valve       A spool valve drawn off its end cap by an electromagnet: coil, spring, stop and drive.
delays      Delays of a spool valve by its film: how long it sticks, and how late it closes.
assumptions  Plausible ranges of what is assumed about the fuel injector, with reasons.
monolithic  Monolithic model of spool, film and coil, by another method than
            `contactkit.separation.motion`.
report      Running the fuel injector from the command line.
cavity_pieces  Cavity of the film in a monolithic simulation: its equation, its events, its memory.
"""

"""Film on a face that is no disc: its shape, its damping law, and its cavity.

shape        Shape of the film between two faces, and its law in closed form where there is one.
grid         The same shape on a grid: planform, holes, and what the gap has beside the shortest.
film         Damping of a full film over its gap, with the error of its grid and table.
rough        Damping law of an even face with fine roughness, by flow factors.
cavity       Cavity of such a film, with the memory of its liquid on the grid.
rim          Rim of liquid around a cavity: whether it is resolved.
held_voids   Force of a film whose voids stay, over gap and speed.
"""

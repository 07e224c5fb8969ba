"""Contact of rough layered surfaces: plan, solve, result.

engine         One constrained contact after another on one interface: what they share is made once.
film_loop      The load that a film adds to the one imposed, and how many equilibria there are.
grid           Heights of surfaces on a grid, and the grid of a scene.
hardness_loop  The outer iterations of a contact: hardness that depends on displacement, load on the
plan           A contact made ready to solve: what will be simulated can be read before it is.
press          The front door for people who come with a height map in an array.
result         What a contact gives: maps, numbers, and how well they can be trusted.
solve          Solve a contact: the pressure, and then whatever else the scene calls for.
"""

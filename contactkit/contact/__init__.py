"""Contact of rough layered surfaces: plan, solve, result.

press          Entry point for a height map in an array.
grid           Heights of surfaces on a grid, and the grid of a scene.
prepared       What a plan prepares once: heights, compliance and solver of an interface.
plan           Plan of a contact: checked and prepared.
solve          Solve a planned contact, and run the effects that observe it.
friction_loop  Displacement caused by friction, until it agrees with the pressure.
hardness_loop  Hardness that depends on the displacement, until they agree.
film_loop      Load that includes the pull of a film: equilibria.
work           Counts and seconds of a solve.
result         Maps, numbers, and how well they were solved.
"""

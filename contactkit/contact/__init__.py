"""Contact of rough layered surfaces: plan, solve, result.

press          Contact of a height map given as an array.
arrays         Contact of many maps at once, of any array library.
grid           Heights of surfaces on a grid, and the grid of a scene.
prepared       Preparation of a plan, done once: heights, compliance and solver.
plan           Plan of a contact: checked and prepared.
solve          Solve a planned contact, and run the effects that observe it.
chain          Chain of solves, each from those before it, loads downwards.
validity       Ranges of validity: resolution, small slopes, small strains.
plausible      Plausible sizes, which a mistaken unit puts out of their range.
pixel_edges    Edges between the pixels in and out of contact.
patches        Connected spots of a contact, and the distribution of their sizes.
companion      A coarser companion of a contact, on fewer pixels.
discretisation Error of the grid, estimated from companions on wider pixels.
functionals    Numbers of a contact that have a gradient, with their slopes.
adjoint        Gradient of such a number: one more solve with the same operator.
attracted      Linear response of a contact with an attraction, for its gradient.
outer          Outer iteration: unknowns of the effects that agree with the contact.
slip_path      Partial slip of dissimilar bodies: pressing in steps, then a tangential load path.
creep_response Compliance of viscoelastic bodies over a time step; what they remember.
viscoelastic_path Steps of a viscoelastic contact over time.
plastic_history Steps of a loading history; the surface that a plastic contact leaves.
film_estimate  Size of a film force that is reported only, were it in balance.
effects        The physics a contact scene may list.
slip           Partial slip under a tangential load path.
solver         Contact solver: active set on nested grids.
scales         Reference scales: reduced modulus, rms height, area.
work           Counts and seconds of a solve.
result         Maps, numbers, parts of the effects, residual.
"""

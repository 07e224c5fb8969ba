"""The physics a contact scene may list.

base            Base classes: the roles of the effects in the contact problem.
elasticity      Elastic compliance of half-spaces and stacks of layers.
hardness_rules  Rules for the hardness of a body: `HardnessRule`.
plasticity      Hardness: the upper bound of the pressure.
adhesion        Attraction of the surfaces across their gap.
attraction_laws Laws of that attraction: Dugdale, exponential, Lennard-Jones.
plastic_history Loads before that of the scene, with a residual shape.
viscoelasticity Loads over time, on bodies whose moduli relax.
friction        Tangential traction of sliding, and the normal displacement it causes.
partial_slip    Stick and slip under a tangential load path.
stress          Stress below the surface.
film            Meniscus force of a thin liquid film.
island_bridges  An exact bridge on each wet island of the gap.
"""

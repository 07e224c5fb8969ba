"""Reference solutions by independent methods, which share no code with what they check.

Closed forms, other numerical methods, and fits that others have published.

hertz            Hertz: sphere on a half-space.
flat_punch       Flat cylindrical punch on a half-space.
viscoelastic     Sphere on a viscoelastic half-space: Lee and Radok; Ting.
westergaard      Westergaard: rigid wave in one direction.
product_wave     Johnson, Greenwood and Higginson: rigid wave in two directions.
love_patch       Uniform pressure on a rectangle, by quadrature.
partial_slip     Sphere under a tangential force: Cattaneo, Mindlin and Deresiewicz; any contact.
hamilton         Stresses under a sliding sphere.
layered_wave     Wave of pressure on a layered half-space, by integration over the depth.
reynolds         Reynolds' equation of an axisymmetric film, by finite volumes.
elliptic_bridge  Liquid bridges by Legendre's elliptic integrals.
sphere_bridges   Published fits for liquid bridges between spheres: Willett, Lian, Mikami.
viscous_films    Published forces of films: Stefan, Reynolds, Brenner, Goldman, Cox and Brenner.
"""

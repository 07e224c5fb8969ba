"""Films between bodies that deform, by contactkit and by a second method without a rim.

soft_spheres     A sphere on a film between bodies that deform, as a scene.
vibrating_film   Moduli, of half-spaces and layers: Leroy and Charlaix.
sticking_sphere  A film that holds a soft sphere: Bertin, Oratis and Snoeijer.
wet_rebound      A soft sphere thrown at a plane: Davis, Serayssol and Hinch.
soft_approach    A sphere approaches soft layers: Wang, Dhong, Tan and Frechette.
"""

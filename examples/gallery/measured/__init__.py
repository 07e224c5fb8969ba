"""Contactkit against programs and measurements of others.

cases             What they have computed or measured, with source, licence and status.
round_loads       Fields of uniform round loads on layers, by quadrature.
layered_programs  Layered half-space: ELLEA1, BISAR, KENLAYER, GAMES.
contact_ball      Ball on a plane on 19 x 19 elements: CONTACT.
contact_square    Stress under a loaded, sheared square: CONTACT.
rough_area        Real area of rough surfaces: the law quoted from Pastewka and Robbins.
sphere_bridges    Bridges between spheres: Willett, Lian, Mikami.
hertz_mindlin     A sphere pressed and sheared: Hertz, Cattaneo, Mindlin, Deresiewicz.
sphere_adhesion   Adhesion of a sphere: JKR, DMT, Maugis, and the fits of Carpick.
rupture_work      Work of rupture with and without evaporation: de Boer.
measured_bridges  Bridges measured by Pitois, which are not met, and why.
film_forces       Films: Stefan, Reynolds, Brenner, Goldman.
film_moduli       Film between bodies that deform, vibrating: Leroy and Charlaix.
capillary_rough   Rough solids pulled together by condensed water: Persson.
soft_pull         Soft spheres pulled off a film: Davis, Serayssol and Hinch.
soft_spheres      A sphere on a film between bodies that deform, as a scene.
unbounded_film    The same without a rim, by Galerkin's method: a second method.
vibrating_film    Moduli by both methods, of half-spaces and layers: Leroy and Charlaix.
sticking_sphere   A film that holds a soft sphere: Bertin, Oratis and Snoeijer.
wet_rebound       A soft sphere thrown at a plane: Davis, Serayssol and Hinch.
soft_approach     A sphere approaches soft layers: Wang, Dhong, Tan and Frechette.
rough_wet_pull    A rough soft sphere pressed on a film and pulled off it.
cold_oil          Walther's law for a cold oil, and what it does to the injector.
"""

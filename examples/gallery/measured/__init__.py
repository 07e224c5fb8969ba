"""Contactkit against programs and measurements of others.

cases              What they have computed or measured, with source, licence and status.
round_loads        Fields of uniform round loads on layers, by quadrature.
layered_programs   Layered half-space: ELLEA1, BISAR, KENLAYER, GAMES.
contact_ball       Ball on a plane on 19 x 19 elements: CONTACT.
contact_square     Stress under a loaded, sheared square: CONTACT.
rough_area         Real area of rough surfaces: the law quoted from Pastewka and Robbins.
contact_challenge  The contact-mechanics challenge: Muser and others.
full_contact       Up to full contact: Johnson, Greenwood and Higginson; Persson.
laser_bumps        Stiction on laser bumps: Gui and Marchon.
bridge_rupture     Rupture of bridges over speed: the law quoted from Pitois.
sphere_bridges     Bridges between spheres: Willett, Lian, Mikami.
hertz_mindlin      A sphere pressed and sheared: Hertz, Cattaneo, Mindlin, Deresiewicz.
sphere_adhesion    Adhesion of a sphere: JKR, DMT, Maugis, and the fits of Carpick.
rupture_work       Work of rupture with and without evaporation: de Boer.
measured_bridges   Bridges measured by Pitois, which are not met, and why.
film_forces        Films: Stefan, Reynolds, Brenner, Goldman.
film_moduli        Film between bodies that deform, vibrating: Leroy and Charlaix.
capillary_rough    Rough solids pulled together by condensed water: Persson.
soft_pull          Soft spheres pulled off a film: Davis, Serayssol and Hinch.
rough_wet_pull     A rough soft sphere pressed on a film and pulled off it.
cold_oil           Walther's law for a cold oil, and what it does to the injector.
"""

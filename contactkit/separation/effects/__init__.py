"""Effects of a separation: forces between the bodies, limits of the liquid, ends of the film.

base             Roles of an effect in the equation of motion: force, limit, end of the film.
force_law        Prepared law of a force: F(h, v), its slopes and its range.
rheology_view    Rheology of a film as the effects of a scene see it.
prepared         Scene with its liquid at temperature and the shape of its film.
film_shape       Shape of the film with an upright rim: radius and height over the gap.
published_film   Film of the printed viscous forces: radius and height of the printed arc.
viscous          Viscous force of the film, and its limits: tension and shear.
film_validity    Numbers of validity of a viscous film: compression, soft faces, weight.
constant_force   Time to open the film under a constant pull, without inertia.
meniscus         Meniscus force, and the choice of its profile.
meniscus_flat    Meniscus force between flats: free, or pinned at the rim.
meniscus_sphere  Meniscus force on a sphere, as a curve over the gap.
meniscus_shape   Neck, contact circles, pressure and volume of the meniscus along the gap.
rupture          Rupture of the film.
asperities       Menisci at the asperities of a rough flat.
adhesion         Van der Waals attraction, and adhesive contact of a sphere.
as_published     Printed and consistent equations, which no result mixes.
"""

"""The physics a separation scene may call for.

adhesion         Attraction of the solids: across a gap, and of a sphere that has touched (JKR, DMT,
as_published     As published or consistent: which choices take printed equations that are known to
asperities       Menisci at the asperities of a rough face: one bridge at each summit within reach.
base             The roles a piece of physics may play in a separation, read off the equation of mot
film_shape       How far the film reaches, as the viscous force and its limits see it: with an uprig
meniscus         The meniscus force: what the curved surface of the liquid makes it pull, or push.
meniscus_flat    The meniscus force between flats: free at constant volume, or held by the rim of th
meniscus_sphere  The meniscus force on a sphere, solved once along the gap and read off a curve in t
registry         The physics a separation scene may call for; those of a contact are in `contact`.
rupture          Where the film breaks.
viscous          The viscous force of the film, and the limits of what the film can carry.
"""

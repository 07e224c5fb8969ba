"""Analyses that solve many scenes: humidity curves, pull-off curves, divided menisci.

adhesion_curve  The contact side of adhesion: radius and approach of a sphere over the load that pre
division        One meniscus divided into many: how the forces change, and which number is best.
division_laws   What N equal menisci between two flats pull, by the law chosen: exact, arc, or as pr
humidity_curve  Meniscus force against relative humidity: of a sphere, of asperities, of a solved co
"""

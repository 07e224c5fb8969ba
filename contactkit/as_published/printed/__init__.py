"""Equations exactly as printed, errata included.

common   Meniscus forces of chapter 3, by equation number.
viscous  Viscous forces of chapter 3.
films    Kelvin radius, film pressures and volumes, division of menisci of chapter 3.
sliding  Tangential separation.
contact  Datum, autocorrelation, film force and stress measures of chapter 2 and Appendix A.
errata   Errata of the printed equations.
"""

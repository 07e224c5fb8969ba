"""Load-displacement curve of a rough contact: loading, unloading after yield, impact.

curve   Force and areas over the approach, with unloading curves, as tables without numpy.
solve   Computation of the curve: contacts under rising loads, and unloading curves.
impact  Impact of a mass on a rough contact; the contact in series with a spring.
"""

"""Analyses of films between bodies that deform: many pulls, and small vibrations.

pull_off_speed  Pull-off force over the opening speed.
release         Time of release over the pull, or over the time of rest.
modulus         Storage and loss modulus over the frequency.
stiction        Pull-off force over time of rest and humidity.
"""

"""The head-disk interface: its scene, and the stiction of a landing bump.

assumptions  Plausible ranges of what is assumed, for `contactkit.sensitivity`.
stiction     Pull-off force of a bump over time of rest and humidity; why the rough disk has none.
"""

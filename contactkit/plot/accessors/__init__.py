"""Figures of results, curves, studies and plans as methods: ``result.plot``.

base        Base class: lists the figures that can be drawn.
contact     Figures of a contact and of its plan.
separation  Figures of a separation and of a sliding.
analyses    Figures of curves and other answers that take many solves.
fitting     Figures of a fit.
studies     Figures of a study, a sensitivity, and of Sobol indices.
scene       Figures of a gradient.
"""

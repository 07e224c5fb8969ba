"""Shortcuts: one physical quantity from one call, by the models of the scenes.

menisci       `capillary_force` in humid air and `bridge_force` of a given volume.
squeeze       `squeeze_time` of a viscous film between flats.
contact_area  `contact_area` of a rough surface under a pressure.
"""

"""The equations of the source by number, as printed and corrected.

lookup                 An equation by its number: printed value, erratum, corrected value.
contact                Table of the printed equations of rough contact and its stress.
capillary_and_viscous  Table of the printed capillary and viscous equations.
sliding                Table of the printed equations of tangential separation.
corrected              Corrected values of the printed equations.
arguments              Arguments and results of printed equations, with their units.
printed                The equations exactly as printed, and their errata.
"""

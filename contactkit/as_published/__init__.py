"""The equations of the source by number, as printed and corrected.

arguments              What a printed formula is given and gives: arguments by name with their units
capillary_and_viscous  The printed equations, one row for each: how it reads, what it needs, what pu
corrected              The right value beside each printed capillary equation: exact bridges, one fo
lookup                 The source's equations by their numbers: as printed, what is wrong, and the r
sliding                The printed equations of tangential separation, as rows of `PUBLISHED`, with
"""

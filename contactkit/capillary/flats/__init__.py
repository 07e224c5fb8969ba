"""Force law of an exact bridge between flats, tabulated once for a pair of contact angles.

family     The exact bridges between flats as a family of one parameter, in plain numbers.
force_law  The force of the exact bridge between flats as a law of the gap, without numpy, made once
sampling   Members of the family of bridges between flats, as close together as a spline needs them.
"""

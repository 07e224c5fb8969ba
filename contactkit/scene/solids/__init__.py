"""Materials beyond isotropic elastic ones, for bodies and layers.

transverse    Transversely isotropic materials, whose axis is the normal.
viscoelastic  Viscoelastic materials, whose modulus relaxes.
"""

"""Films in C whose viscosity follows pressure and shear: what that changes their force by."""

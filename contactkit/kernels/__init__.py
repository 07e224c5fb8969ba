"""Formulas as pure functions, on arrays or floats; only public doors check what they get."""

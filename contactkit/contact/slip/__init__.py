"""Partial slip: stick and slip of a contact under tangential load, by Coulomb's law.

operator    Tangential displacement under tractions between the pixels in contact.
discs       Tractions inside the friction bound: projection, and free directions.
step        Implicit step of Coulomb friction: conjugate gradients on the free tractions.
load_path   States of a contact along a tangential load path.
coupling    Normal displacement of the bodies in contact under tangential tractions.
states      Results of partial slip: states, maps and numbers.
"""

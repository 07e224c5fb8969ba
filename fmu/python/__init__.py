"""FMUs that run in Python: build, carried modules, integrity.

build      Writing FMU files: `build` makes one, `validate` lets fmpy check it.
integrity  That an FMU runs the code it was built from, and no other.
vendor     Which source files an FMU has to carry: the modules its slave imports, and what they impo
"""

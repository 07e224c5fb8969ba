"""FMUs that run in Python: build, carried modules, integrity.

build      Writing FMU files: `build` makes one, `validate` lets fmpy check it.
integrity  Integrity of an FMU: it runs the code it was built from, and no other.
vendor     Source files that an FMU carries: the modules its slave imports, and those they import.
guard      A guard in C between a host and the library of pythonfmu.
"""

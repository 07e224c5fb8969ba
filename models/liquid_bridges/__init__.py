"""Liquid bridges whose closures are compared.

scene           The file of a comparison of closures of liquid bridges: contact angles, and the
                filling.
closure_errors  Errors of the arc and the published forces against the exact bridge, up to its
                rupture.
report          Running the comparison from the command line.
"""

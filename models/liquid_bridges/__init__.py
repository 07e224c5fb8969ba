"""Liquid bridges whose closures are compared.

scene  The file of a comparison of closures of liquid bridges: contact angles, and the filling.
"""

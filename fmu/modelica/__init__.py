"""Modelica wrappers of FMUs: flanges of the standard library around the block that a tool imports.

element  Parts of a mechanical model: an FMU's variables by their roles, and the signs of its force.
package  The Modelica package around an FMU, written from its model description.
text     Text of Modelica: strings, parameters, connectors, graphics.
"""

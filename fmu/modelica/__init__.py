"""Modelica wrappers of FMUs: flanges of the standard library around the block that a tool imports.

element  What an FMU is between or at flanges: its variables by their roles, and the signs.
package  The Modelica package around an FMU, written from its model description.
text     Text of Modelica: strings, parameters, connectors, graphics.
"""

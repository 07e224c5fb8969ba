"""The C kernel of native FMUs.

tips  The tips of ``tip-contact`` in C: their motion, flight and impacts.
"""

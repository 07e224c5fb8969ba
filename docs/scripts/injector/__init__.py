"""Measured numbers of the fuel injector: ``python docs/scripts/injector [NAME ...] [--write]``.

coupling  Cost of a communication step in accuracy, by host and master.
delays    Release, closing and refilling by the monolithic model.
"""

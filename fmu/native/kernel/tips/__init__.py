"""The tips of ``tip-contact`` in C: their motion, flight and impacts."""

"""Future work of the source, sections 2.4 and 3.5, as far as contactkit has it.

rough_separation     Random rough surfaces drawn apart: menisci at summits of unlike heights.
exact_menisci        Free boundary: the solution of Young and Laplace in place of an arc.
other_profiles       A parabola and an ellipse in place of an arc, against the exact meridian.
vibration            A gap that vibrates while it opens: viscous and meniscus force.
sliding_angles       Advancing and receding contact angle in tangential separation.
stick_slip           A wet slider that is driven through a spring.
"""

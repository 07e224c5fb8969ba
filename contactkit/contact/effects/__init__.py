"""The physics a contact scene may call for.

base            The roles a piece of physics may play in a contact, read off the problem that is sol
elasticity      How the bodies yield: homogeneous half-spaces, or stacks of layers.
film            The meniscus force of a thin liquid film on a rough contact.
friction        Quasi-static sliding: the traction that friction puts on the bodies, and what it dis
hardness_rules  Hardness of a layered solid as an indenter feels it, from the hardness of its materi
island_bridges  Exact bridges on the islands of a rough contact: each wetted summit has one of its o
plasticity      The largest pressure that the bodies bear.
registry        The physics a contact scene may call for: `CONTACT_EFFECTS` is the whole registry.
stress          Stress below the surface, plane by plane.
"""

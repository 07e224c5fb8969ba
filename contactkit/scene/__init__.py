"""What a user describes: bodies, liquids, interface, loading and scenes.

asperity_population  The summits of a rough surface as a population of spheres.
bodies               What is pressed together: two bodies, perhaps a liquid between them, and the wi
contact_scene        A contact, and which physics it calls for. What is not listed is not run.
imposed              Motions that are imposed besides a plain opening: sliding at a held gap, and a
interface            Two bodies, the liquid between them, and what pulls them apart.
materials            What the bodies are made of: materials, and layers of them bonded to a substrat
meniscus             The liquid between two bodies: how much of it, or at which pressure, and how it
scenes               What is there, and which physics it calls for. What is not listed is not run.
shapes               The surfaces a liquid film lies between.
topography           Surfaces of bodies in contact: recipes that are made into heights on a grid whe
"""

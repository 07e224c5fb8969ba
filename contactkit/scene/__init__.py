"""Scene objects: bodies, liquids, interface, loading and scenes; base classes of plan and result.

materials            Materials, and stacks of layers bonded to a substrate.
solids               Viscoelastic and transversely isotropic materials.
surfaces             Base class of all surfaces; flat, sphere, paraboloid and wave.
planforms            Planforms of a face: discs, rings, rectangles, images, and their sums.
faces                Holes and recesses of a face.
rough_surfaces       Random roughness, height maps, and sums of surfaces.
topography           Topography objects of other packages as surfaces.
asperity_population  Summits of a rough surface as a population of spheres.
meniscus             Liquid between two bodies: its amount and its contact angles.
interface            Two bodies and the meniscus between them; the conventions of signs.
window               Part of the interface that a contact is solved in, and its grid.
loading              Imposed speed, force or time; pressing or approach; sliding.
effect               Base class of all effects, and their registry.
scenes               Contact, separation and sliding: interface, loading and effects.
plan                 Base class of all plans.
answer               Base class of results, curves and studies: numbers, sources, figures, a file.
result               Base class of all results.
scales               Reference scales of a result.
curve                Curves: columns over one axis, each with its unit, and the numbers that follow.
gradient             A number of a result and its slopes.
figures              Figures of a result as methods, which the room that draws fills in.
tabular              Results as tables: quantities with axes, units and labels.
description          A scene in words, with units that read well.
column               Name, unit, label and line of a quantity.
"""

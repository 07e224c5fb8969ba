"""Accuracy and cost: error of each setting against a reference, with its counts and seconds.

table            Table of accuracy studies: what is solved, over which settings, against which
                 reference.
contact_studies  Accuracy of contact solvers beyond a single contact: slip, adhesion, histories,
                 curves, lines.
scene_cost   Cost of accuracy of a scene, by its kind: table, numbers, picture and CSV file.
report       Report of a work-precision study: table, numbers, advice, picture and CSV file.
separation   Work and precision of a separation under an imposed force: error of the release time.
contact      Work-precision of a contact over tolerance and grid, by solver and by effect.
effects      Cost of each effect of a contact.
"""

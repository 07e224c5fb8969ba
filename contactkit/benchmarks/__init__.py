"""Accuracy and cost: error of each setting against a reference, with its counts and seconds.

table               Table of studies of accuracy and of hard cases.
contact_studies     Accuracy of contacts of spheres: pressure, slip, adhesion, histories, lines.
rough_studies       Accuracy of rough contacts: methods, presets, grids, layers, load curves.
layered_studies     Accuracy of layered solids and of the stress below contacts.
separation_studies  Accuracy of separations: release times of films, FMUs, laws of menisci.
film_studies        Accuracy of films on grids: full films, cavities, a native FMU.
references          Reference solutions, computed by other means: files of JSON.
hard                Hard cases: where a plain method loses all digits, never ends, or has no answer.
releases            Release of a mass from a film: four cases that two other codes solve.
timing              CPU seconds and counts of a run.
scene_cost          Cost of accuracy of a scene, by its kind: table, numbers, picture and CSV file.
report              Report of a work-precision study: table, numbers, advice, picture and CSV file.
separation          Work and precision of a separation under an imposed force.
contact             Work-precision of a contact over tolerance and grid, by solver and by effect.
effects             Cost of each effect of a contact.
"""

"""Works to cite for a scene, a plan or a result, with their entries of BibTeX.

In reading order:

stated       Sources that a scene states of its data: materials, liquids and their laws, roughness.
citations    Works, and what each of them is cited for.
cite         `cite`: the works behind a scene, a plan, a result, a curve, a study or a fit.
"""

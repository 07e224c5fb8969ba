"""Pages of solved contacts: maps over load and depth, sections, areas over load.

page    `contact_page`: the text of a page, and what its scripts read.
loads   The loads of a page, contacts solved under them, and the errors of their grid.
views   The whole window and a close-up, on as many cells as there is room for.
maps    Maps of a result that a page shows, and the areas it outlines.
stress  Planes of stress and what is shown on them.
numbers Numbers over the load, with the error of the grid.
images  Maps of fewer cells and levels, packed.
"""

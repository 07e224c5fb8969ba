"""Every figure and table of the source, one script each: ``contactkit gallery``.

chapter_2    Contact of rough layered surfaces, dry and wet.
chapter_3    Separation of wetted surfaces.
measured     Against programs and measurements of others.
deforming    Films between bodies that deform, by a second method.
future_work  Future work of the source, as far as contactkit has it.
second_method  A second solver, layers, bridges and films, which the pages are held against.
"""

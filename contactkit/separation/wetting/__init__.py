"""Dynamic wetting: what a bridge does beyond a static meniscus, each effect called for by name.

line           Rim of the film as its contact line moves, and what that needs of a scene.
weight         Weight of the liquid.
cox_voinov     Contact angle that depends on the speed of the line.
landau_levich  Liquid that a receding line leaves behind.
losing_film    Forces of a film whose volume falls along the gap.
trouton        Extensional stress of the column of liquid.
rupture        Rupture distance that grows with speed.
"""

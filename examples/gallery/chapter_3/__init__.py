"""Figures and tables of chapters 1, 3 and 4: separation of wetted surfaces.

films           Films of the captions, their volumes, the three closures of the force.
figure_1_02     Adhesion of a pin over the humidity.
figure_1_03     A lens pulled out of castor oil.
figure_1_04     Meniscus against van der Waals force.
figure_3_07     Meridians between flats.
figure_3_08     Meridians under a sphere.
figure_3_09     Meniscus force over the separation of flats.
figure_3_10     Viscous force over the separation of flats.
figure_3_11     Forces on a sphere, with and without a gap at the start.
figure_3_12     Forces over the contact angles.
figure_3_13     Viscous force over the separation time.
figure_3_14     Forces over the area, critical area.
figure_3_15     A film divided into N menisci.
figure_3_16     Many asperities, many menisci.
figure_3_18     Viscous force over a slide, Figs. 3.18 and 3.19.
figure_3_20     Viscous force of a slide over its time.
figure_3_21     Viscous force of a slide over the number of asperities.
section_3_2_3   Break distances that the source validates itself with.
tables_3_1_3_2  Trends of the forces, computed.
table_4_1       The equations, evaluated beside the right values.
"""

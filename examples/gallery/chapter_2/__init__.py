"""Figures and tables of chapter 2: contact of rough layered surfaces, dry and wet.

figure_2_01        Pressure under a sphere on a layered half-space.
figure_2_02        Stress below it, with friction, in sections to scale.
figure_2_03        A rough sphere on a layer.
figure_2_08        Heights of three rough surfaces.
figure_2_09        Pressure and stress of the three surfaces.
figure_2_10        Load curves of structures I to V, thick layers.
figure_2_12        Pressure and stress of structures I to V, thick layers.
figure_2_13        Structures I to V, thin layers.
figure_2_14        Homogeneous bodies of three hardnesses.
figure_2_15        Hardness of layers by two rules.
figure_2_16        Maximum stress over friction, stiffness.
figure_2_19        Maximum stress over friction, hardness.
figure_2_23        Meniscus force, stiffness.
figure_2_24        Meniscus force, hardness.
figure_2_25        Meniscus force of the three surfaces.
layered_equations  Equations of two layers on a substrate, as printed and right.
table_2_1          Materials.
table_2_2          Arrows of the summary, computed.
grid_refinement    Grid and shortest wave.
layered_sphere     One solve of a sphere on one layer.
printed_layers     Potentials of the source for two layers, with errata on demand.
rough_contact      Surfaces, structures and load curves of the rough contacts.
stress_maps        Maps of pressure and stress, and maxima over seeds.
curve_figure       Panels of load curves.
"""

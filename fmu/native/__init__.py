"""Native FMUs: one C kernel for all models, and the tables of one scene.

build        Writing native FMUs: one C kernel for all models, and the tables of one scene.
drive        Writing native FMUs without a film: ``valve-drive``, ``contact-stop``.
tip          Writing the native FMU ``tip-contact``: film and site of a tip as tables, the tip
             in C.
models       The models of the kernel: one description of each, which Python and C follow.
record       Records: named members that Python writes and the C kernel reads, from one
             declaration.
records      Records in the file of a native FMU: films as tables, rough faces as curves.
data         The file ``resources/film.bin`` of a native FMU: variables, tables and faces, for C.
component    The C kernel as a WebAssembly component: the sixth binary of a native FMU of FMI 3.0.
sources      The sources of the kernel of a native FMU: its files, and those made of the
             description.
faces        The load-displacement curve of rough faces as the record that the C kernel reads.
deforming    Native FMUs of a film between bodies that deform: a spring in series, or the film on
             rings.
film         The film of a scene as the tables that the C kernel of a native FMU reads.
grid         Grid of a film that cavitates on a face that is no disc.
tables       Functions of the gap as quintic Hermite tables, for the C kernel of a native FMU.
rheology     Films whose viscosity follows pressure and shear, as the tables that the kernel reads.
ratios       Ratios of forces over gap and speed as splines, for the C kernel of a native FMU.
ports        The variables of a native FMU: those of the Python FMU of that name that a table
             leaves free.
description  Model descriptions and build descriptions of native FMUs, in both versions of FMI.
page         The page of documentation in a native FMU.
reference    Reference results of a film: the motion of its scene by `ck.simulate`, put into its
             FMU.
kernel       The C kernel of native FMUs.
"""

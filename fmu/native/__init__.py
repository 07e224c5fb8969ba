"""Native FMUs: one C kernel for all models, and the tables of one scene.

build        Writing a native FMU of a film, or of a mass with its film.
drive        Writing a native ``valve-drive``.
film         The film of a scene as the numbers that the kernel reads.
tables       Forces as tables that the kernel interpolates.
ports        The variables of a native FMU.
data         The file of variables and tables, ``resources/film.bin``.
description  Model descriptions of FMI 2.0 and 3.0.
page         The documentation of a native FMU.
kernel       The sources in C.
"""

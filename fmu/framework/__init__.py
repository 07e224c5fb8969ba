"""FMI variables, model description, access and state of an FMU.

access        Reading and writing the variables of a slave, and telling the host what went wrong.
description   The model description (FMI 2.0) of a table of ports, complete where pythonfmu's is
              not.
description3  The model description (FMI 3.0) of a table of ports, and the description of a build.
instance      One FMU in fmpy, driven by the names of its variables.
model_file    The model description of an FMU file, which is checked before it is read.
places        Parameters of an FMU as fields of the scene behind it: one table for both directions.
ports         Ports: what the variables of an FMU are called, mean, and may be.
slave         `PortSlave`: an FMI 2.0 co-simulation slave whose variables are a table of ports.
state         The state of a slave as plain data: taken, written as bytes, checked when it comes
              back.
tables        Look-up tables of a class of slaves, made once from its ports, so that calls are
              cheap.
toolchain     Compiling the C kernel of native FMUs: for every platform with zig, for this one with
              cc too.
"""

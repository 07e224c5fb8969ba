"""Parameter studies on processes or a cluster.

study        `study`: a scene solved over a grid of parameter values.
sensitivity  `sensitivity`: what each assumption does to a quantity over its plausible range.
columns      Base class of studies: columns over the product of the parameters, figures, file.
table        The result of a study: points, bands, table.
stream       `stream_study`: a study of many points, written to a file as they are solved.
study_file   File of such a study, a SQLite database, read column by column.
estimate     `plan_study`: points, time, memory and disk of a study, from a few trial points.
bands        Aggregation over seeds: median, mean and band.
paths        Dotted paths into a scene: the parameters of a study.
run          Pieces of points that are solved one after the other.
spread       Spreading of pieces: in this process, over processes, or on a client; retries.
store        Folder of finished points, one file each.
"""

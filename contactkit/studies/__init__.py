"""Parameter studies on processes or a cluster.

study  `study`: a scene solved over a grid of parameter values.
sensitivity  `sensitivity`: what each assumption does to an answer over its plausible range.
table  The result of a study: points, columns, table and file.
bands  Aggregation over seeds: median, mean and band.
paths  Dotted paths into a scene: the parameters of a study.
run    Execution of the points: in this process, in processes, or on a client.
store  Folder of finished points, one file each.
"""

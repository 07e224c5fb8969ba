"""Parameter studies on processes or a cluster.

paths  Dotted paths into a scene: what a study varies, read and applied.
run    Run the pieces of a study: one after the other here, in processes, or wherever a client likes
store  Points of a study, and the folder they are kept in: one file each, whole or not there.
study  Studies: one scene solved for many values of what is in it.
table  What a study gives: its points, as columns, as a table and as a file.
"""

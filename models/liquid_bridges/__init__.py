"""The scene of the comparison of liquid bridges."""

"""Films between bodies that deform in C: what a film is, its implicit steps, and the models."""

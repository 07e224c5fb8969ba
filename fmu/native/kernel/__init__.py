"""The C kernel of native FMUs."""

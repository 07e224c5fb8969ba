"""The head-disk interface: its scene."""

"""Figures and tables of chapters 3 and 4: separation of wetted surfaces."""

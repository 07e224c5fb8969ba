"""The local app of ``contactkit app``."""

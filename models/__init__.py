"""The devices contactkit is shown on, and the data of their materials and liquids."""

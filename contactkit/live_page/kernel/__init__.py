"""Entry points of the C kernel for a page."""

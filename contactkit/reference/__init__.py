"""Solutions by other means, to compare with: slow, simple and independent of the kernels."""

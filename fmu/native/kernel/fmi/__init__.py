"""The functions of FMI 2 and 3 in C, and the host they are called by."""

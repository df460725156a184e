"""Functions of the ISO dialect."""

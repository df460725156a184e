"""polycnc: an open CNC control in software."""

__version__ = "0.1.0"

"""Axes that others stand in for: what is programmed is Cartesian, what moves is not.

`polar` (G12.1, TRANSMIT), `cylinder` (G07.1, TRACYL), `groove` (the same with walls), `inclined` (TRAANG), `standing`
(G07), `parallel` (other axes are X, Y, Z).
"""

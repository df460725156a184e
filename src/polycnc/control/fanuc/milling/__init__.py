"""The FANUC machining centre (`fanuc-m`).

`control`, `codes` (its tables), `five_axes` (G41.2), `leading_edge` (G41.3), `cycles` (drilling), `variables`,
`parameters` (written from the list beside it).
"""

"""The FANUC machining centre (`fanuc-m`).

`control`, `codes` (its tables), `cycles` (drilling), `variables`, `parameters` (written from the list beside it).
"""

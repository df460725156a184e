"""The FANUC machining centre (`fanuc-m`): `control`, `codes` (its tables), `cycles` (drilling), `variables`."""

"""Auxiliary functions: `functions` (F, S, T, M), `overrides` (M73 to M76), `interlocks` of the machine's controller."""

"""Vectors, frames, arcs and offsetting: pure functions on numbers, with no idea of a control."""

"""Cycles over a point: `drilling` (G73 to G89), `hole_patterns` (circle, line, arc, grid).

`plunge` writes the rows of a plain hole at once, `holes_as_data` tells the scanner of it; `shift` is the way off the
wall in G76 and G87, `hole_halts` where single block halts in a hole.
"""

"""Drilling cycles as strokes: `holes`, `deep_hole` (division of depths), `lathe` (what lathes add), `patterns`."""

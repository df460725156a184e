"""Coordinate systems of SYNTEC: `systems` (G52 to G59, G68, G10), `turns` (G54.4), `length`, `tool_setting` (G37)."""

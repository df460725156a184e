"""Coordinate systems of SYNTEC: `systems` (G52 to G59, G68, G10), `turns` (G54.4), `length` (G43).

`tool_setting` is G37, `diameters` says which axes are programmed in diameters (G10.9).
"""

"""Coordinate systems: `systems` (G52 to G59, G92, G28 to G30), `frames` (G51, G68, G16), `stroke_check` (G22, G23).

`on_table` are work zeros that go with a rotary table (G54.2, G54.4), `tip` is the seat of tool tip control (G43.4)
between them and the axes.
"""

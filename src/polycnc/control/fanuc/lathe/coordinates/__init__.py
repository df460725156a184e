"""Coordinate systems of the lathe: `systems` (G50, G53 …), `limits` (G22, strokes), `barrier` (chuck and tailstock).

`tilted` has tilted planes and 3-D conversion (G68.1 I J K, G68.2).
"""

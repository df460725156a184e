"""Coordinate systems of the lathe: `systems` (G50, G53 …), `limits` (G22, strokes), `barrier` (chuck and tailstock)."""

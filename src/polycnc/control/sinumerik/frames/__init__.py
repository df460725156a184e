"""Frames: `memory` (stored and active ones), `active` (in the coordinates), `codes` (TRANS …), `adding` (ADDFRAME).

`variables` are `$P_UIFR` and its likes, `tool_frames` TOROT, TOFRAME and PAROT.
"""

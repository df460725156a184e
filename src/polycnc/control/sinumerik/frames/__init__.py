"""Frames: `memory` (stored and active ones), `codes` (TRANS …), `variables` (`$P_UIFR` …), `adding` (ADDFRAME)."""

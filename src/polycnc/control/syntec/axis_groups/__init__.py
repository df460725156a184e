"""Axis groups of SYNTEC: `groups` (`$1`, `$2` …), `borrowing` (G52.2), `names` (axis names, virtual axes)."""

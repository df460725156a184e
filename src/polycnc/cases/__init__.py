"""Regression tests of part programs: cases in YAML, run against their expectations (`polycnc test`)."""

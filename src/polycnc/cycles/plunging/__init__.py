"""Turning by heights over places.

`profile` says how deep a tool's point may go, `cuts` plunges and turns there, `material` tells what is left.
"""

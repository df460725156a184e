"""Tests of runs as they are laid."""

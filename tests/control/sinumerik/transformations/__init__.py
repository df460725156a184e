"""Tests of transformations and orientation."""

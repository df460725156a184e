"""Tests of radius compensation in space."""

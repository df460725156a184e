"""Tests of turning cycles."""

"""Tests of contours of cycles."""

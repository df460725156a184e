"""Tests of plunging."""

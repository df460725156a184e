"""Turning with a tool that has a width: `profile` says how deep its point may go, `cuts` plunges and turns there."""

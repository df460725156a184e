"""Benchmarks: every figure is a ratio to a peer or to a stated limit, measured in the same run."""

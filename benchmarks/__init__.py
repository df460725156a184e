"""Speed and quality against the project's limits: `python -m benchmarks`."""

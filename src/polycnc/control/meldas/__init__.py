"""The MELDAS (Mitsubishi) family."""

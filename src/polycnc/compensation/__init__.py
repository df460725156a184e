"""Cutter and nose radius compensation as a stage of the path, with each control's rules as a policy."""

"""The command line: one module for each command, imported when it is called."""

from polycnc.cli.app import main

__all__ = ["main"]

"""Routines: subprograms, macros and loops whose lines have been read once, so that the scanner runs them by itself.

`layout` names the fields of a line that is kept and of a call that runs; `flow` holds what such lines do, as kernels;
`kept` reads the lines of a routine, `statements` is how a control tells what its statements do; `running` gives a scan
what it must know, and makes levels of the program stack of calls in which the interpreter goes on.
"""

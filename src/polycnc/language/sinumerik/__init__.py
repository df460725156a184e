"""The NC language of SINUMERIK 840D sl: blocks, expressions, variables, flow, calls, compiled to steps.

The way of a block: `executable` finds its line and asks `shapes` for a step of its shape; else `lexer` makes
tokens, `blocks` chooses what they are (`flow`, `definitions`, `calls`, assignments, `nc_words`),
`expressions` compiles values, and `emitter` turns the code into a step.
"""

from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.sections import end_of_subprogram

__all__ = ["SinumerikProgram", "end_of_subprogram"]

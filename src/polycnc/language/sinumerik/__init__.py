"""The NC language of SINUMERIK 840D sl: blocks, expressions, variables, flow, calls, compiled to steps.

The way of a block: `executable` finds its line and asks `shapes` for a step of its shape; else `lexer` makes tokens
(`keywords` is the vocabulary), `blocks` chooses what they are, `expressions` compiles values, and `emitter` turns the
code into a step, which `joining` puts together with those that follow; `runtime` is what compiled blocks call
(`formatting` for SPRINT).
`iso_dialect` tells blocks of ISO code in the control's own words.
`nc_words` with `words` is what the control gets; `interface` is what language and control ask of each other; `errors`
are its alarms, `place` where one is shown.

    actions/      synchronised actions
    statements/   flow, calls, definitions, files
    names/        variables, their values and types, rights, units
"""

from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.statements.sections import end_of_subprogram

__all__ = ["SinumerikProgram", "end_of_subprogram"]

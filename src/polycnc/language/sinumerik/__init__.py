"""The NC language of SINUMERIK 840D sl: blocks, expressions, variables, flow, calls, compiled to steps.

The way of a block: `executable` finds its line and asks `shapes` for a step of its shape; else `lexer` makes tokens
(`keywords` is the vocabulary), `blocks` chooses what they are, `expressions` compiles values, and `emitter` turns the
code into a step, which `joining` puts together with those that follow; `runtime` is what compiled blocks call.

    statements   flow with labels and structures, calls with sections (program levels), definitions, redefinitions,
                 files, nc_words with words (what the control gets)
    names        scope, places (of values), variables, level_variables, nc_frame, values (types), units, vocabulary,
                 rights
    data         definition_files, initialisation
    alarms       errors, place (where one is shown)
    control      interface: what language and control ask of each other
"""

from polycnc.language.sinumerik.executable import SinumerikProgram
from polycnc.language.sinumerik.sections import end_of_subprogram

__all__ = ["SinumerikProgram", "end_of_subprogram"]

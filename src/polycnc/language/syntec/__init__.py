"""The SYNTEC macro language and SYNTEC ISO text: tokens, typed values, expressions, statements, programs.

`executable` makes a file ready to run: `tokens`, then `statements` in a flat `layout`, or `blocks` of words;
`expressions` are compiled with the `functions` and `values` of the language.
"""

from polycnc.language.syntec.executable import IsoProgram, MacroProgram, executable, iso_grammar
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value

__all__ = ["VACANT", "IsoProgram", "MacroProgram", "Text", "Vacant", "Value", "executable", "iso_grammar"]

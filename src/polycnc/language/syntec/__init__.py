"""The SYNTEC macro language and SYNTEC ISO text: tokens, typed values, expressions, statements, programs."""

from polycnc.language.syntec.executable import IsoProgram, MacroProgram, executable
from polycnc.language.syntec.values import VACANT, Text, Vacant, Value

__all__ = ["VACANT", "IsoProgram", "MacroProgram", "Text", "Vacant", "Value", "executable"]

"""Word-address text: blocks of lettered words (`words`), and custom macro B between them.

`executable` makes a line a step: a block of words, or a macro statement (`statements`), whose expressions `macro_b`
compiles with the `functions` of the language; `patterns` knows the lines that differ in numbers only. `joining` makes
one step of several that follow each other.
"""

from polycnc.language.word_address.executable import Grammar, WordAddressProgram
from polycnc.language.word_address.words import WordBlock, word_key

__all__ = ["Grammar", "WordAddressProgram", "WordBlock", "word_key"]

"""Word-address text: blocks of lettered words, and custom macro B between them."""

from polycnc.language.word_address.executable import Grammar, WordAddressProgram
from polycnc.language.word_address.words import WordBlock, word_key

__all__ = ["Grammar", "WordAddressProgram", "WordBlock", "word_key"]

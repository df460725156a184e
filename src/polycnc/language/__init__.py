"""From the text of a program to the steps that a channel runs: lexers, parsers and expression compilers.

One folder for each language: `word_address` with custom macro B, `syntec` with its macro language, `sinumerik`. They
share the kit of `expressions`; `bulk` is the short cut for plain blocks of all of them.
"""

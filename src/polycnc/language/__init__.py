"""Lexers, parsers and expression compilers: word address with macro B, SYNTEC macro, SINUMERIK."""

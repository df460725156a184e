"""What costs time to make is made when it is first used, so that a short program pays for nothing but what it uses.

`records` has the decorator of dataclasses, `named_tuples` the base of named tuples, `regexes` regular expressions,
`contexts` context managers, `modules` imports by name, `toml` reads TOML; all are used as those of the library. `paths`
says of texts what `pathlib` says of paths. `class_statements` gives a decorator the body of a class before there is
one. `functions` is for tables that name functions of many modules.
"""

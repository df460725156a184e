"""What the languages' expressions have in common.

- `cursor`: a place among the tokens of a text.
- `operators`: the reader of expressions, driven by a table of operators that each language gives.
- `code`: the Python code that an expression or a statement stands for, as a value; `nodes`: the kinds of its nodes.
- `hot_loop`: joined steps that the scanner takes over.
- `joined`: what code of several steps that became one says to the channel.
- `shapes`: code compiled once for each shape, with the numbers of a block as its parameters.
"""

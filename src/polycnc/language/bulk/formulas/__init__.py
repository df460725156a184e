"""Formulas in words and statements.

`reading` follows them down the tree of shapes, `calculating` works them out on a stack: kernels. `postfix` makes
operations of the code of expressions, `typed_postfix` of that of a language whose values have types.
"""

"""Bulk scanning: runs of plain blocks go from the bytes of the program straight into columns of the toolpath.

`kernels` reads and works off blocks, `numerals` reads their numbers, `formulas` reads and calculates formulas in
them, and makes them of the code of expressions, `moves` holds what they do; all are pure functions on arrays
(`layout` names the fields, `conversions` what becomes of numbers), also as machine code (`compiled`); `routines`
holds what they need for subprograms, macros and loops; `buffers` gives them the bytes, and room. `recipe` is how a
control declares that a block of some shape in some modal state is plain, `shapes` keeps what was declared in the
kernels' tables; `settings` says whether a program is long enough, `scanner` leads a channel through all that, whose
programs are as `scannable` says; `staged` hands scanned moves to stages of the path. `guard` watches the travel of the
axes behind a tool's tip, by the kernel in `reach`. Whatever is not plain goes to the interpreter, block by block. Both
ways give the same table, bit for bit.
"""

from polycnc.language.bulk.recipe import (
    Arc,
    Call,
    Condition,
    Conditions,
    Conversion,
    Enter,
    Idle,
    Later,
    Note,
    Recipe,
    Return,
    Scaling,
    SetFeed,
    Spelling,
    Step,
    Straight,
    Target,
    Word,
    declare,
    declared,
)

__all__ = [
    "Arc",
    "Call",
    "Condition",
    "Conditions",
    "Conversion",
    "Enter",
    "Idle",
    "Later",
    "Note",
    "Recipe",
    "Return",
    "Scaling",
    "SetFeed",
    "Spelling",
    "Step",
    "Straight",
    "Target",
    "Word",
    "declare",
    "declared",
]

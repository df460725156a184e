"""The data of routines by name."""

from __future__ import annotations

from polycnc.kernels.layout import Places, place

#: No routine runs: blocks come from the text. No loop with a number is open.
NO_ROUTINE, NO_LOOP = -1, 0


class Line(Places):
    """A record of `lines`: a line of a routine."""

    #: What it does (`LineKind`), and its number in the file.
    KIND = place()
    NUMBER = place()
    #: Keys of a block; values of its words, then the numbers of its formulas, or those of a statement.
    FIRST_KEY = place()
    KEYS = place()
    FIRST_VALUE = place()
    WORDS = place()
    LITERALS = place()
    #: What a statement calculates, 0 for nothing; the step to which it jumps, or the routine that it calls; the number
    #: of its loop.
    FORMULAS = place()
    TARGET = place()
    LOOP = place()
    #: Modal state in which the block was met last, and its node in the tree of shapes.
    ROOT = place()
    NODE = place()


class LineKind(Places):
    """What a line of a routine does.

    It has not been read; it is the interpreter's; nothing; a block; it calculates; it jumps (where its condition
    holds); it opens a loop (where its condition holds, else it jumps); it ends one, and jumps where the condition of
    the loop holds; it calls a routine, so often as is calculated; it leaves one; so does the end of the text, which is
    no block.
    """

    UNREAD = place()
    REFUSED = place()
    NOTHING = place()
    BLOCK = place()
    STATEMENT = place()
    JUMP = place()
    LOOP = place()
    LOOP_END = place()
    CALL = place()
    RETURN = place()
    END = place()


class Routine(Places):
    """A record of `routines`: its first line, the step of that, how many there are, and the number of its program."""

    FIRST_LINE = place()
    FIRST_STEP = place()
    LINES = place()
    PROGRAM = place()


class Frame(Places):
    """A record of `frames`: a call that runs.

    Routine of the caller, and the step at which it goes on; the routine that runs, whether it has local variables of
    its own, and how often it runs again; the caller's loops.
    """

    CALLER = place()
    BACK_AT = place()
    CALLED = place()
    IS_MACRO = place()
    REPEATS = place()
    LOOPS = place(4)

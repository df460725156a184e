"""Which block comes next within routines: statements, loops, calls and returns. Kernels; see `layout`.

A line changes nothing before it is certain that all of it can be done. What cannot stays for the interpreter, which
goes on at the very line.
"""

from __future__ import annotations

from math import nan

from polycnc.kernels.layout import Floats, Ints32
from polycnc.language.bulk.formulas.calculating import calculate
from polycnc.language.bulk.layout import (
    KEY_COUNT,
    LOCALS,
    LOOPS,
    MOST_WORDS,
    Flow,
    Leaf,
    Outcome,
    Rule,
    State,
    Tables,
)
from polycnc.language.bulk.moves import word
from polycnc.language.bulk.routines.layout import NO_LOOP, NO_ROUTINE, Frame, Line, LineKind, Routine

#: What `take_line` gives instead of the node of a block: the line is done; it calls a routine, or leaves the running
#: one, as the end of its text does; it is the interpreter's, or has not been read.
DONE, CALLS, RETURNS, ENDS, REFUSED, UNREAD = -1, -2, -3, -4, -5, -6
#: What `program_called` gives beside the number of a routine.
NOT_KNOWN, NOT_SCANNED = -1, -2
#: A line calls a routine so often at the most (SINUMERIK: P).
MOST_PASSES = 9999.0


def take_line(tables: Tables, state: State) -> int:
    """Take the next line of the routine: a statement is carried out, of a block the node of its shape is given."""
    lines = tables.lines
    routine = state.scan.routine * Routine.SIZE
    place = state.scan.index - tables.routines[routine + Routine.FIRST_STEP]
    if place < 0 or place >= tables.routines[routine + Routine.LINES]:
        return REFUSED
    line = (tables.routines[routine + Routine.FIRST_LINE] + place) * Line.SIZE
    kind = lines[line + Line.KIND]
    if kind <= LineKind.REFUSED:
        return REFUSED if kind == LineKind.REFUSED else UNREAD
    state.scan.block_line = lines[line + Line.NUMBER]
    if kind == LineKind.NOTHING:
        return DONE
    if kind >= LineKind.RETURN:
        if state.scan.frames == 0:
            return REFUSED
        return RETURNS if kind == LineKind.RETURN else ENDS
    put_values(tables, state, line)
    if kind == LineKind.BLOCK:
        return node_of(tables, state, line)
    formulas = lines[line + Line.FORMULAS]
    state.stack[0] = 1.0
    if formulas and not calculate(state, tables.formulas, formulas):
        return REFUSED
    if kind == LineKind.CALL:
        return CALLS if may_call(tables, state, lines[line + Line.TARGET]) else REFUSED
    if kind != LineKind.STATEMENT and not gone_on(lines, state, line, kind, state.stack[0] != 0.0):
        return REFUSED
    return DONE


def put_values(tables: Tables, state: State, line: int) -> None:
    """Values of words and numbers of formulas, as if they had just been read."""
    lines, values, kept = tables.lines, state.values, tables.line_values
    first = lines[line + Line.FIRST_VALUE]
    words = lines[line + Line.WORDS]
    for i in range(words):
        values[i] = kept[first + i]
    first += words
    for i in range(lines[line + Line.LITERALS]):
        values[MOST_WORDS + i] = kept[first + i]


def node_of(tables: Tables, state: State, line: int) -> int:
    """The node of a block's shape in the modal state that holds."""
    lines, nexts = tables.lines, tables.nexts
    root = state.scan.root
    if lines[line + Line.ROOT] == root:
        return int(lines[line + Line.NODE])
    node = root
    first, count = lines[line + Line.FIRST_KEY], lines[line + Line.KEYS]
    for i in range(count):
        key = tables.line_keys[first + i]
        state.keys[i] = key
        node = nexts[node * KEY_COUNT + key]
    state.scan.keys = count
    if tables.leaves[node] >= Leaf.FIRST_RULE:
        lines[line + Line.ROOT], lines[line + Line.NODE] = root, node
    return int(node)


def gone_on(lines: Ints32, state: State, line: int, kind: int, holds: bool) -> bool:
    """Where a statement of flow leads, as the step in front of the next one; false where it is the interpreter's."""
    loop, target = lines[line + Line.LOOP], lines[line + Line.TARGET]
    if kind == LineKind.JUMP:
        if holds:
            state.scan.index = target - 1
        return True
    if kind == LineKind.LOOP:
        if holds:
            state.loops[loop] = state.scan.index + 1
        else:
            state.loops[loop] = NO_LOOP
            state.scan.index = target - 1
        return True
    if state.loops[loop] != target:
        return False
    if holds:
        state.scan.index = target - 1
    else:
        state.loops[loop] = NO_LOOP
    return True


def program_called(tables: Tables, state: State, rule: int, factor: int) -> int:
    """The routine that a block calls, by the number in its word; or what is known instead."""
    number = word(state, tables.rules, tables.factors, rule, factor, Rule.CALLED)
    repeats = 1.0
    if tables.rules[rule + Rule.REPEATS] >= 0:
        repeats = word(state, tables.rules, tables.factors, rule, factor, Rule.REPEATS)
    if not 1.0 <= repeats <= 1e6 or repeats != float(int(repeats)) or not 1.0 <= number <= 1e9:
        return NOT_SCANNED
    if state.scan.frames >= state.scan.most_frames:
        return NOT_SCANNED
    callees = tables.callees
    for i in range(0, len(callees), 2):
        if callees[i] == number:
            return int(callees[i + 1])
    state.scan.called = int(number) if number == float(int(number)) else 0
    return NOT_KNOWN if state.scan.called else NOT_SCANNED


def may_flow(tables: Tables, state: State, rule: int, factor: int) -> int:
    """Whether what a block does to the stack of routines can be done: `GOES_ON`, or how the scan ends."""
    if tables.rules[rule + Rule.FLOW] == Flow.RETURN:
        return Outcome.GOES_ON if state.scan.frames else Outcome.NOT_PLAIN
    routine = program_called(tables, state, rule, factor)
    if routine >= 0:
        return Outcome.GOES_ON
    return Outcome.UNKNOWN_PROGRAM if routine == NOT_KNOWN else Outcome.NOT_PLAIN


def may_call(tables: Tables, state: State, routine: int) -> bool:
    """Whether a line may call a routine, as often as is on the stack: not too deep, and not what is running already."""
    passes = state.stack[0]
    if not 1.0 <= passes <= MOST_PASSES or passes != float(int(passes)):
        return False
    if state.scan.frames >= state.scan.most_frames:
        return False
    program = tables.routines[routine * Routine.SIZE + Routine.PROGRAM]
    if program == state.scan.program:
        return False
    for i in range(state.scan.frames):
        caller = state.frames[i * Frame.SIZE + Frame.CALLER]
        if caller != NO_ROUTINE and program == tables.routines[caller * Routine.SIZE + Routine.PROGRAM]:
            return False
    return True


def call(tables: Tables, state: State) -> None:
    """Call the routine of the line that has just been taken, as often as is on the stack; the caller is behind it."""
    place = state.scan.current - tables.routines[state.scan.routine * Routine.SIZE + Routine.FIRST_STEP]
    line = (tables.routines[state.scan.routine * Routine.SIZE + Routine.FIRST_LINE] + place) * Line.SIZE
    routine = tables.lines[line + Line.TARGET]
    push(state, routine, int(state.stack[0]) - 1, 0)
    state.scan.frames += 1
    run(tables, state, routine)
    state.scan.current = state.scan.index


def push(state: State, routine: int, repeats: int, is_macro: int) -> None:
    """Keep where the caller stands, in a frame that does not count yet."""
    frame, frames = state.scan.frames * Frame.SIZE, state.frames
    frames[frame + Frame.CALLER], frames[frame + Frame.BACK_AT] = state.scan.routine, state.scan.index
    frames[frame + Frame.CALLED], frames[frame + Frame.IS_MACRO] = routine, is_macro
    frames[frame + Frame.REPEATS] = repeats
    for i in range(LOOPS):
        frames[frame + Frame.LOOPS + i] = state.loops[i]
        state.loops[i] = NO_LOOP


def flow(tables: Tables, state: State, rule: int, factor: int) -> None:
    """Call or leave a routine; the caller stands behind the block."""
    if tables.rules[rule + Rule.FLOW] == Flow.RETURN:
        leave(tables, state)
        return
    routine = program_called(tables, state, rule, factor)
    is_macro = tables.rules[rule + Rule.FLOW] == Flow.MACRO
    saved, times = state.scan.frames * LOCALS, 1.0
    if tables.rules[rule + Rule.REPEATS] >= 0:
        times = word(state, tables.rules, tables.factors, rule, factor, Rule.REPEATS)
    push(state, routine, int(times) - 1, is_macro)
    if is_macro:
        for i in range(1, LOCALS):
            state.saved[saved + i] = state.variables[i]
            state.variables[i] = nan
        put_arguments(state, tables.rules, tables.factors, rule, factor)
    state.scan.frames += 1
    run(tables, state, routine)
    state.scan.current = state.scan.index


def put_arguments(state: State, rules: Ints32, factors: Floats, rule: int, factor: int) -> None:
    """Local variables of a macro as its call has them."""
    for i in range(rules[rule + Rule.TARGETS]):
        which = Rule.FIRST_TARGET + 4 * i
        state.variables[rules[rule + which + 2]] = word(state, rules, factors, rule, factor, which)


def run(tables: Tables, state: State, routine: int) -> None:
    """A routine runs, from its first line on."""
    state.scan.routine = routine
    state.scan.index = tables.routines[routine * Routine.SIZE + Routine.FIRST_STEP]
    state.scan.program = tables.routines[routine * Routine.SIZE + Routine.PROGRAM]


def leave(tables: Tables, state: State) -> None:
    """The routine has come to its end: it runs once more, or its caller goes on."""
    last = state.scan.frames - 1
    frame, frames = last * Frame.SIZE, state.frames
    if frames[frame + Frame.REPEATS] > 0:
        frames[frame + Frame.REPEATS] -= 1
        for i in range(LOOPS):
            state.loops[i] = NO_LOOP
        run(tables, state, frames[frame + Frame.CALLED])
        return
    if frames[frame + Frame.IS_MACRO]:
        for i in range(1, LOCALS):
            state.variables[i] = state.saved[last * LOCALS + i]
    for i in range(LOOPS):
        state.loops[i] = frames[frame + Frame.LOOPS + i]
    caller = frames[frame + Frame.CALLER]
    state.scan.frames = last
    state.scan.routine, state.scan.index = caller, frames[frame + Frame.BACK_AT]
    state.scan.current = state.scan.index - 1
    state.scan.program = state.scan.text_program
    if caller != NO_ROUTINE:
        state.scan.program = tables.routines[caller * Routine.SIZE + Routine.PROGRAM]

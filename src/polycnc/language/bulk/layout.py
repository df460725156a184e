"""The data of the scanner's kernels by name: what a scan carries along, rules, flags and outcomes.

Python's side (`shapes`, `scanner`) and the kernels share it.
"""

from __future__ import annotations

from array import array
from math import inf

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Bytes, Floats, Ints, Ints32, Places, Text, Words16, Words32, place, record
from polycnc.language.bulk.routines.layout import Frame
from polycnc.transformation.orientation.records import StandRecord

#: Words that a block may have; numbers in their formulas, which stand behind the words' values; keys of both.
MOST_WORDS, MOST_LITERALS, MOST_KEYS = 24, 72, 128
#: Variables: those that text names by their numbers, then those that only a routine's lines name. Vacant ones are no
#: numbers; where no variable lies, it is infinite.
NUMBERED, VARIABLES = 1000, 4000
#: Values that a formula may have at a time, and such that it keeps for later; variables that a line may change.
STACK, HELD, CHANGES = 32, 8, 16
#: Bit of a mark of block skip without a level.
PLAIN_MARK = 10
#: Local variables of a macro, with one that there is not; numbers of loops, likewise.
LOCALS, LOOPS = 34, 4
#: Routines that may have called each other.
MOST_FRAMES = 8

#: Strokes of a hole that the scanner makes.
MOST_STROKES = 128


class Strokes(Places):
    """What the tool does at the end of a block that drills: strokes along one axis.

    How many, -1 for what the interpreter must do; root of the modal state in which that is so; the axis; where the tool
    must stand on it, and at which feed; where it stands behind them; how many blocks they count; the lowest and the
    highest of their places; how many of them are dwells. Then kind, feed (of a dwell its seconds) and place of each.
    """

    COUNT = place()
    ROOT = place()
    AXIS = place()
    LEVEL = place()
    FEED = place()
    END = place()
    BLOCKS = place()
    RANGE = place(2)
    DWELLS = place()
    FIRST = place(3 * MOST_STROKES)


# ---- what a scan carries along ------------------------------------------------------------------------------


@record
class Scan(Structure):
    """Where a scan stands, and what holds in it.

    Attributes:
        place: Byte of the text at which the next block begins.
        end: Byte behind the last line; the last byte is a line end.
        line: Line of the file of the next block in the text.
        block_line: Line of the block that is being worked off, in the text or in a routine; `program` is the number of
            its program, `text_program` that of the text.
        routine: The routine that runs (`routines`), `NO_ROUTINE` while blocks come from the text; `index` is the step
            that comes next, `current` the last one.
        frames: Routines that have been called and not left; `most_frames` how many may be.
        called: The number of a program that is called and not known yet.
        blocks: Blocks taken so far; `most_blocks` how many may be. `rows` and `notes` likewise.
        curves: Moves with curve parameters among the rows; `most_curves` how many may be, `first_curve` the number that
            the first one gets.
        root: Root of the shape tree for the modal state that holds.
        axes: Axes of the channel.
        has_programming: Whether the programming frame changes anything; `has_zero` likewise.
        direct: Whether programmed point and display are one.
        owes: Whether incremental words are owed something.
        shifted: Whether there are shifts of single axes.
        mirrors: Whether the programming frame swaps left and right.
        limited: Whether axes have limits.
        grammar: What the control's text looks like, flags of `Grammar`.
        most_digits: Digits that a number may have.
        keys: Keys of the block that is being read.
        numbered: Variables that text may name by their numbers.
        skipped: Levels of block skip that are on, by bits, `PLAIN_MARK` for a mark without one; below zero where marked
            blocks are the interpreter's.
        changes: Variables that the line which is being worked out has changed.
        turned: Blocks that have stood the tool along a direction.
        dwells: Dwells in holes.
        feed: The channel's feed.
        tolerance: Allowed difference between the radii at an arc's start and end, mm.
    """

    place: int
    end: int
    line: int
    block_line: int
    program: int
    text_program: int
    routine: int
    index: int
    current: int
    frames: int
    most_frames: int
    called: int
    blocks: int
    most_blocks: int
    rows: int
    most_rows: int
    notes: int
    most_notes: int
    curves: int
    most_curves: int
    first_curve: int
    root: int
    axes: int
    has_programming: int
    has_zero: int
    direct: int
    owes: int
    shifted: int
    mirrors: int
    limited: int
    grammar: int
    most_digits: int
    keys: int
    numbered: int
    skipped: int
    changes: int
    turned: int
    dwells: int
    feed: float
    tolerance: float


class State(NamedTuple):
    """What a scan carries along; see `new_state`.

    Attributes:
        scan: Where it stands, and what holds.
        keys: Keys of the words of the block that is being read.
        values: Values of its words, then the numbers in its formulas.
        variables: Variables that formulas read, by number.
        stack: What is being calculated, then what is kept for later in it.
        changed: Places and former values of variables that the line which is being worked out has changed.
        frames: Of every call that runs, what was left (`routines.layout.Frame`).
        strokes: The strokes of a hole at the end of a block that drills (`Strokes`).
        loops: By the number of a loop the step behind the one that opened it; 0 for none.
        saved: Local variables of those who have called macros.
        geometry: For X, Y, Z of the geometry their columns, or -1.
        last_center: Centre of the last arc less its start, on the geometry axes.
        programming: The programming frame: nine numbers by rows, then the shift.
        zero: The zero frame.
        position: Where the channel stands, as the display shows it; from here on a number for each axis.
        programmed: The programmed point.
        pending: What incremental words are owed.
        shift: Shifts of single axes.
        offsets: From the zero frame's image to the machine position.
        low: Lowest machine position; `high` likewise.
        new_position: The same behind the block that is being worked out; `new_programmed`, `new_pending` likewise.
        machine: Its machine position without offsets.
        came_from: Where the last move began.
        turned_from: Where the last block began that stood the tool along a direction; `turned_to` where it ended.
        tool: What must be known for that (`transformation.orientation.standing`).
    """

    scan: Scan
    keys: Ints
    values: Floats
    variables: Floats
    stack: Floats
    changed: Floats
    frames: Ints
    strokes: Floats
    loops: Ints
    saved: Floats
    geometry: Ints
    last_center: Floats
    programming: Floats
    zero: Floats
    position: Floats
    programmed: Floats
    pending: Floats
    shift: Floats
    offsets: Floats
    low: Floats
    high: Floats
    new_position: Floats
    new_programmed: Floats
    new_pending: Floats
    machine: Floats
    came_from: Floats
    turned_from: Floats
    turned_to: Floats
    tool: Floats


class Tables(NamedTuple):
    """What a scan reads; the rules of blocks, and routines.

    Attributes:
        text: Text, whole lines.
        nexts: The shape tree, `(nodes, KEY_COUNT)`.
        leaves: For each node the number of its rule.
        rules: `(rules, Rule.SIZE)`.
        factors: `(rules, Factor.SIZE)`.
        formulas: What rules calculate, pairs of `Operation` and argument.
        routines: `(routines, Routine.SIZE)`, see `routines.layout`; from here on what is known of routines.
        lines: Their lines, `(lines, Line.SIZE)`.
        line_keys: Keys of their blocks; `line_values` their values.
        callees: Pairs of a program's number and that of its routine, or `NOT_SCANNED`.
    """

    text: Text
    nexts: Ints32
    leaves: Ints32
    rules: Ints32
    factors: Floats
    formulas: Ints32
    routines: Ints32
    lines: Ints32
    line_keys: Ints32
    line_values: Floats
    callees: Ints32


class Columns(NamedTuple):
    """Columns of the toolpath that a scan writes; `end` flat, `curves` flat with `CURVE_WIDTH` numbers a row.

    Notes beside them: `notes` flat with `NOTE_WIDTH` numbers each, `said` with its value and the position each.
    """

    kind: Bytes
    program: Words16
    line: Words32
    feed: Floats
    end: Floats
    curve: Ints32
    curves: Floats
    notes: Ints
    said: Floats


def new_state(axes: int) -> State:
    """Room for what a scan carries along."""

    def zeros(count: int) -> array[float]:
        return array("d", bytes(8 * count))

    fixed = (
        array("q", bytes(8 * MOST_KEYS)),
        zeros(MOST_WORDS + MOST_LITERALS),
        array("d", (inf,)) * VARIABLES,
        zeros(STACK + HELD),
        zeros(2 * CHANGES),
        array("q", bytes(8 * Frame.SIZE * MOST_FRAMES)),
        zeros(Strokes.SIZE),
        array("q", bytes(8 * LOOPS)),
        zeros(LOCALS * MOST_FRAMES),
        array("q", bytes(24)),
        zeros(3),
        zeros(12),
        zeros(12),
    )
    standing = zeros(axes), zeros(axes), zeros(axes), zeros(axes), zeros(axes), zeros(axes), zeros(axes)
    moving = zeros(axes), zeros(axes), zeros(axes), zeros(axes), zeros(axes)
    turning = zeros(axes), zeros(axes), zeros(StandRecord.SIZE)
    return State(Scan(axes=axes), *fixed, *standing, *moving, *turning)


# ---- what a block of a shape does ---------------------------------------------------------------------------

#: Numbers of an axis word in a rule: index of its value, conversion, axis, whether it is an increment.
TARGET_WIDTH = 4


class Rule(Places):
    """A record of `rules`: whole numbers. A word is the index of its value, or -1, and its conversion."""

    #: Root of the shape tree of the modal state that the block leaves.
    NEXT_STATE = place()
    #: Kind of motion, whether it needs a feed, whether a rapid names its feed, whether all words are absolute,
    #: whether ways below `TINY` are none.
    MOTION = place()
    NEEDS_FEED = place()
    NAMES_FEED = place()
    ABSOLUTE = place()
    SKIPS_TINY = place()
    #: Plane of an arc as geometry axes, its sense, and whether an arc without way in its plane is a line.
    PLANE = place(3)
    CCW = place()
    LINE_WITHOUT_WAY = place()
    #: Words beside axes.
    FEED_WORD = place(2)
    FIRST_CENTER = place(2)
    SECOND_CENTER = place(2)
    RADIUS = place(2)
    #: Axis words: how many, and from where on.
    TARGETS = place()
    FIRST_TARGET = place(TARGET_WIDTH * MOST_WORDS)
    #: Whether a feed that is not above zero is the interpreter's.
    POSITIVE_FEED = place()
    #: Whether the block leaves a note, and the index of that note's value, or -1.
    LEAVES_NOTE = place()
    NOTE_WORD = place()
    #: Where its formulas begin, 0 for none.
    FORMULAS = place()
    #: Whether the block names a direction of the tool, and the indices of its values, -1 for zero.
    HAS_DIRECTION = place()
    DIRECTION = place(3)
    #: Whether the block calls a routine or leaves one (`Flow`), the words of the program and of how often it runs. Axis
    #: words are arguments, their axes variables.
    FLOW = place()
    #: The axis, plus one, along which strokes follow behind its move; 0 for none.
    DRILLS = place()
    CALLED = place(2)
    REPEATS = place(2)


class Factor(Places):
    """A record of `factors`."""

    #: Scale and unit of each conversion. A word's stand at the same place as the word in its rule.
    WORDS = place(Rule.SIZE)
    #: How often the control's arc tolerance counts where a radius is given.
    RADIUS_TOLERANCES = place()
    #: A smaller value of a note is the interpreter's.
    LOWEST_NOTE = place()


class Motion(Places):
    """Kinds of motion of a rule."""

    NONE = place()
    RAPID = place()
    FEED = place()
    ARC = place()


class Flow(Places):
    """What a block does to the stack of routines."""

    NONE = place()
    SUBPROGRAM = place()
    MACRO = place()
    RETURN = place()


class NoteRecord(Places):
    """What blocks leave beside rows: rows in front of the note, line and rule of its block.

    Its value and the position follow among the floats.
    """

    ROW = place()
    LINE = place()
    RULE = place()


# ---- formulas -----------------------------------------------------------------------------------------------


class Token(Places):
    """What a formula in a block is written with; `VARIABLE`, `NUMBER` and `DECIMAL` have a number each.

    Where the form of a number counts, `DECIMAL` is one with a point. `NUMBERED` is the sign of a variable whose number
    follows in brackets.
    """

    OPEN = place()
    CLOSE = place()
    VARIABLE = place()
    NUMBER = place()
    DECIMAL = place()
    PLUS = place()
    MINUS = place()
    TIMES = place()
    DIVIDED = place()
    SIN = place()
    COS = place()
    SQRT = place()
    ABS = place()
    FIX = place()
    FUP = place()
    TAN = place()
    ROUND = place()
    TRUNC = place()
    POT = place()
    ASIN = place()
    ACOS = place()
    ATAN = place()
    MOD = place()
    AND = place()
    OR = place()
    XOR = place()
    COMMA = place()
    NUMBERED = place()


class Operation(Places):
    """What is done with a stack of values, with an argument each.

    The end of a block's formulas; where the value is no condition that holds, nothing more is done.

    Onto the stack comes a number of the formula, or the variable of such a number (while it is vacant the interpreter
    decides, or it is 0, or no number), or no number, the variable at a place, the argument itself, what was kept.

    The value is kept for later, and stays; it becomes that of a word, of the variable of a number of the formula, of
    the one whose number is below it, of the one at a place, or of an element (its index on top) of those from a place
    on.

    Of one value: the variable of that number (as above, while it is vacant); an element from a place on, by its index;
    the index as it is, if there are so many elements. A whole number stays one (of those that are exact; of INT).
    Signs, truth, functions (`TANGENT`, `HALF_AWAY`, `MODULO` and those of bits as custom macro B has them, `TURN` an
    angle within a turn); operators between two values; comparisons between two.
    """

    END = place()
    UNLESS = place()

    NUMBER = place()
    VARIABLE = place()
    VARIABLE_OR_ZERO = place()
    VARIABLE_OR_VACANT = place()
    VACANT = place()
    PLACE = place()
    ARGUMENT = place()
    HELD = place()

    HOLD = place()
    STORE = place()
    ASSIGN = place()
    ASSIGN_NUMBERED = place()
    PUT = place()
    PUT_ELEMENT = place()

    NUMBERED = place()
    NUMBERED_OR_ZERO = place()
    NUMBERED_OR_VACANT = place()
    ELEMENT = place()
    WITHIN = place()
    EXACT = place()
    INTEGER = place()
    NEGATIVE = place()
    NOT = place()
    ABS = place()
    SQRT = place()
    SQUARE = place()
    ASIN = place()
    ACOS = place()
    SIN = place()
    COS = place()
    TAN = place()
    TRUNC = place()
    ROUND = place()
    CEIL = place()
    FIX = place()
    FUP = place()
    ATAN = place()
    TURN = place()
    TANGENT = place()
    HALF_AWAY = place()

    ADD = place()
    SUBTRACT = place()
    MULTIPLY = place()
    DIVIDE = place()
    QUOTIENT = place()
    REMAINDER = place()
    ATAN2 = place()
    MODULO = place()
    BITS_AND = place()
    BITS_OR = place()
    BITS_XOR = place()
    LESSER = place()
    GREATER_ONE = place()
    AND = place()
    OR = place()
    NEAR = place()
    EQUAL = place()
    NOT_EQUAL = place()
    GREATER = place()
    GREATER_OR_EQUAL = place()
    LESS = place()
    LESS_OR_EQUAL = place()


# ---- text ---------------------------------------------------------------------------------------------------


class Grammar(Places):
    """What a control's text looks like: flags."""

    #: Comments in round brackets; one without its end goes to the end of the line; `//` to the end of the line.
    ROUND_COMMENTS = 1
    OPEN_COMMENTS = 2
    SLASH_COMMENTS = 4
    #: `;` begins a comment (else it ends the block); `X=1` is a word.
    SEMICOLON_COMMENTS = 8
    EQUALS = 16
    #: How a number was written is part of a block's shape; lines without a block are no blocks.
    FORMS_COUNT = 32
    BLANK_LINES_ARE_NONE = 64
    #: `0X1` may be a hexadecimal number; `CR=` is an address.
    HEXADECIMAL = 128
    CR_RADIUS = 256
    #: `(* … *)` may be a comment, which no other bracket ends.
    STARRED_COMMENTS = 512
    #: `X[#1+2.]` and `X#1` are words.
    FORMULAS = 1024
    #: `A3=`, `B3=` and `C3=` are words.
    DIRECTIONS = 2048
    #: `M3` is a code, else a word.
    M_CODES = 4096
    #: `X=R1*2` and `R1=R2` are words.
    EXPRESSIONS = 8192


#: Keys of words: letter and form (four each), then G codes below `LAST_CODE`, M codes below `LAST_M_CODE`, letters of
#: words with a formula, and what formulas are written with.
FORMS = 4
#: `CR=` as a form of C.
CR_FORM = 2
#: `A3=` and its like as a form of their letters.
DIRECTION_FORM = 3
FIRST_CODE = 26 * FORMS
LAST_CODE = 1000
FIRST_M_CODE, LAST_M_CODE = FIRST_CODE + LAST_CODE, 100
FIRST_FORMULA = FIRST_M_CODE + LAST_M_CODE
#: `CR=` with a formula; an assignment (`R1=`, `#1=`), which is no word: `R[#1]` is one of R.
CR_FORMULA = FIRST_FORMULA + 26
ASSIGNED = CR_FORMULA + 1
FIRST_TOKEN = ASSIGNED + 1
#: Begins the keys of a line that a routine knows by its number; figures follow, as tokens.
LINE_KEY = FIRST_TOKEN + Token.SIZE
KEY_COUNT = LINE_KEY + 1

# ---- outcome of a scan --------------------------------------------------------------------------------------


class Outcome(Places):
    """How a scan ended.

    The text is at its end; no room for another row or block; the next block has a shape that is not known yet; the next
    block is for the interpreter, or calls a program that is not known yet, or is a line that has not been read. Within:
    the scan goes on.
    """

    AT_END = place()
    FULL = place()
    UNKNOWN = place()
    NOT_PLAIN = place()
    UNKNOWN_PROGRAM = place()
    UNREAD = place()
    GOES_ON = place()


class Leaf(Places):
    """What a shape's leaf says beside the number of its rule."""

    UNKNOWN = place()
    NOT_PLAIN = place()
    FIRST_RULE = place()

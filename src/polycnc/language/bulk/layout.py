"""Where the scanner's numbers stand: its kernels know arrays only, so every number has a fixed place in one.

Python's side (`shapes`, `scanner`) and the kernels share these names. Compiled code takes them as constants.
"""

from __future__ import annotations

# ---- whole numbers of a scan (`ints`) -----------------------------------------------------------------------

#: Byte of the text at which the next block begins, and behind the last line; the last byte is a line end.
PLACE, END = 0, 1
#: Line of the file of the next block.
LINE = 2
#: Blocks and rows taken so far, and how many may be; moves with curve parameters among them.
BLOCKS, MOST_BLOCKS, ROWS, MOST_ROWS, CURVES, FIRST_CURVE = 3, 4, 5, 6, 7, 8
#: Number of the shape tree's root for the modal state that holds.
STATE = 9
#: Axes of the channel, and for X, Y, Z of the geometry their columns, or -1.
AXES, GEOMETRY = 10, 11
#: Place of the programming frame and of the zero frame among the floats, or -1 for identity.
PROGRAMMING_FRAME, ZERO_FRAME = 14, 15
#: Whether programmed point and display are one, whether incremental words are owed something, whether there
#: are shifts of single axes, whether the programming frame swaps left and right, whether axes have limits.
DIRECT, OWES, SHIFTED, MIRRORS, LIMITED = 16, 17, 18, 19, 20
#: What the control's text looks like: flags of `GRAMMAR_FLAGS`, and digits that a number may have.
GRAMMAR, MOST_DIGITS = 21, 22
#: Notes so far, and how many may be.
NOTES, MOST_NOTES = 23, 24
#: The keys of the block that is being read: how many, and from where on.
KEYS, FIRST_KEY, MOST_KEYS = 25, 26, 24
INTS = FIRST_KEY + MOST_KEYS

# ---- numbers of a scan (`floats`) ---------------------------------------------------------------------------

FEED, TOLERANCE = 0, 1
#: Centre of the last arc less its start, on the geometry axes.
LAST_CENTER = 2
#: Values of the words of the block that is being read.
VALUES = 5
#: Frames: nine numbers by rows, then the shift.
PROGRAMMING, ZERO = VALUES + MOST_KEYS, VALUES + MOST_KEYS + 12
#: From here on vectors with a number for each axis, in this order.
VECTORS = ZERO + 12
POSITION, PROGRAMMED, PENDING, SHIFT, OFFSETS, LOW, HIGH = range(7)
#: The same while a block is worked out, and where the last move began.
NEW_POSITION, NEW_PROGRAMMED, NEW_PENDING, MACHINE, CAME_FROM = range(7, 12)
VECTOR_COUNT = 12

# ---- what a block of a shape does (`rules`, whole numbers, and `factors`) -----------------------------------

#: Root of the shape tree of the modal state that the block leaves.
NEXT_STATE = 0
#: Kind of motion, whether it needs a feed, whether a rapid names its feed, whether all words are absolute,
#: whether ways below `TINY` are none.
MOTION, NEEDS_FEED, NAMES_FEED, ABSOLUTE, SKIPS_TINY = 1, 2, 3, 4, 5
#: Plane of an arc as geometry axes, its sense, and whether an arc without way in its plane is a line.
PLANE, CCW, LINE_WITHOUT_WAY = 6, 9, 10
#: Words beside axes: index of the value, or -1, and its conversion.
FEED_WORD, FIRST_CENTER, SECOND_CENTER, RADIUS = 11, 13, 15, 17
#: Axis words: how many, and from where on, each with index of the value, conversion, axis, incremental.
TARGETS, FIRST_TARGET, TARGET_WIDTH = 19, 20, 4
#: Whether a feed that is not above zero is the interpreter's.
POSITIVE_FEED = FIRST_TARGET + TARGET_WIDTH * MOST_KEYS
#: Whether the block leaves a note, and the index of that note's value, or -1.
LEAVES_NOTE, NOTE_WORD = POSITIVE_FEED + 1, POSITIVE_FEED + 2
RULE_WIDTH = POSITIVE_FEED + 3
#: Factors: scale and unit of each conversion. A word's stand at the same index as its value's index in `rules`.
FACTOR_WIDTH = RULE_WIDTH + 2
#: How often the control's arc tolerance counts where a radius is given.
RADIUS_TOLERANCES = RULE_WIDTH
#: A smaller value of a note is the interpreter's.
LOWEST_NOTE = RULE_WIDTH + 1

NO_MOTION, RAPID_MOTION, FEED_MOTION, ARC_MOTION = range(4)

# ---- what blocks leave beside rows: notes ---------------------------------------------------------------------

#: Rows in front of the note, line and rule of its block. Its value and the position follow among the floats.
NOTE_ROW, NOTE_LINE, NOTE_RULE = range(3)
NOTE_WIDTH = 3

# ---- conversions --------------------------------------------------------------------------------------------

#: As it is; value * unit; value / scale * unit; digits below 1/scale cut off, * unit; value * unit / scale.
AS_IS, TIMES, INCREMENTS, CUT, RATIO = range(5)

# ---- text ---------------------------------------------------------------------------------------------------

#: Comments in round brackets; one without its end goes to the end of the line; `//` to the end of the line.
ROUND_COMMENTS, OPEN_COMMENTS, SLASH_COMMENTS = 1, 2, 4
#: `;` begins a comment (else it ends the block); `X=1` is a word.
SEMICOLON_COMMENTS, EQUALS = 8, 16
#: How a number was written is part of a block's shape; lines without a block are no blocks.
FORMS_COUNT, BLANK_LINES_ARE_NONE = 32, 64
#: `0X1` may be a hexadecimal number; `CR=` is an address.
HEXADECIMAL, CR_RADIUS = 128, 256
#: `(* … *)` may be a comment, which no other bracket ends.
STARRED_COMMENTS = 512

#: Keys of words: letter and form (four each), then G codes below `LAST_CODE`.
FORMS = 4
#: `CR=` as a form of C.
CR_FORM = 2
FIRST_CODE = 26 * FORMS
LAST_CODE = 1000
KEY_COUNT = FIRST_CODE + LAST_CODE

# ---- outcome of a scan --------------------------------------------------------------------------------------

#: The text is at its end; no room for another row or block; the next block has a shape that is not known yet;
#: the next block is for the interpreter.
AT_END, FULL, UNKNOWN, NOT_PLAIN = range(4)
#: What a shape's leaf says beside the number of its rule.
LEAF_UNKNOWN, LEAF_NOT_PLAIN, FIRST_RULE = 0, 1, 2

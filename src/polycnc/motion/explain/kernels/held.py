"""What the kernels of the account share: numbers of causes, notes of rows, tables of limits, and the account itself."""

from __future__ import annotations

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.kernels.c_types import Structure
from polycnc.kernels.layout import Floats, Places, place, record

#: Part by which speeds that count as one may differ; squares of the speeds at a joint; a speed that follows the turning
#: radius, which a piece of an arc has in its middle alone.
SAME, SAME_JOINT, SAME_RADIUS = 1e-6, 1e-5, 1e-2
#: Part by which the squared speed on a piece of a curve may change that counts as steady.
EVEN = 0.05
#: Part by which the speed of a law of limited jerk stays below that which bounds it.
BELOW = 0.01
#: Use of an axis's acceleration or jerk, in parts of it, that counts as none; from which on a curve is said to bind.
STEADY, BINDS = 0.05, 0.5
#: No axis.
WHOLE = -1


class Held(Places):
    """Numbers of the causes: those of `causes.Cause`, in its order, and REAL, for which Python looks at real axes."""

    FEED = place()
    PATH_FEED = place()
    AXIS_FEED = place()
    AXES = place()
    PROGRAM_AXIS = place()
    OVERLAID = place()
    FOLLOWING = place()
    BLOCK_TIME = place()
    CORNERS = place()
    CORNER_STEP = place()
    LINE_PULL = place()
    ARC_PULL = place()
    CURVATURE = place()
    ACCELERATION = place()
    SPINDLE_PULL = place()
    JERK = place()
    CORNER_JERK = place()
    SETTLING = place()
    TIME_CONSTANT = place()
    STANDSTILL = place()
    RAPID = place()
    REAL = place()
    #: None of them: what comes next says it.
    LATER = place()


class Note(Places):
    """What bounds a row. Speeds along the path are infinite where nothing bounds them.

    RECORD says where the record of its context begins, KIND is that of the kernels, LIMITS the number of its limits.
    ASKED is the speed that the program asks for, 0 where it asks for none; RADIUS the turning radius for which it does,
    0 where it holds all along, FACING what X of the work is above X of the machine, and COLUMN that of X. PATH is the
    control's highest feed, BLOCK what it keeps up with, ARC what parameters allow on the arc, PLANAR the part of its
    way that lies in its plane (0 of lines), TOP what pace and transformation do, on its first share where it is SHARED
    (1). AFTER says that it is accelerated after the interpolation (1), RAPID that it is a rapid (1). EASE is the part
    of the acceleration of its axes that it may use, TAP_PULL what the spindle allows a tap, else 0. STOP says that the
    axes rest before it whatever its corner is (1).

    Of the joint at its start STEP2 is the squared speed by parameters, of which JOINT is the cause and JOINT_AXIS the
    axis. With averages CORNER2 is that by tolerance and geometry, PULL2 that by the acceleration of PULL_AXIS, and
    JERK_AXIS the axis whose jerk counts for the rest; chords of splines have the last three too.
    """

    RECORD = place()
    KIND = place()
    LIMITS = place()
    ASKED = place()
    RADIUS = place()
    FACING = place()
    COLUMN = place()
    PATH = place()
    BLOCK = place()
    ARC = place()
    PLANAR = place()
    TOP = place()
    SHARED = place()
    AFTER = place()
    RAPID = place()
    EASE = place()
    TAP_PULL = place()
    STOP = place()
    CORNER2 = place()
    STEP2 = place()
    JOINT = place()
    JOINT_AXIS = place()
    PULL2 = place()
    PULL_AXIS = place()
    JERK_AXIS = place()


class Limit(Places):
    """Blocks of n numbers for each limits of the planner; `capped` says that the control caps an axis in cuts (1)."""

    TOP_RAPID = place()
    TOP_FEED = place()
    PULL = place()
    JERK = place()
    ROTARY = place()
    CAPPED = place()


class Pacing(Places):
    """Of each context: whether a transformation acts (1), its pace bounds axes (1); behind BLOCKS n numbers each.

    Highest velocities of axes in cuts, and in rapids: by the program, by their own bound, by what moves over them.
    """

    TRANSFORMED = place()
    PACED = place()
    BLOCKS = place(0)


class Tables(NamedTuple):
    """What rows and pieces refer to.

    Attributes:
        notes: `Note` by `Note`, from a row on.
        contexts: The planner's table of contexts.
        limits: `Limit` blocks.
        paces: `Pacing` by context.
    """

    notes: Floats
    contexts: Floats
    limits: Floats
    paces: Floats


#: Blocks of `Pacing`: by the program, by own bounds, by overlaid motions, in cuts and then the same in rapids.
PACES = 3


@record
class Ledger(Structure):
    """How far the account has come.

    Attributes:
        pending_s: Seconds for which the axes brake, and nobody knows yet for what; `pending_mm` likewise.
        joint2: Squared speed that bounds the last joint, 0 for none; `joint_cause` and `joint_axis` say why.
        known2: Squared speed that bounds the piece before without its neighbours.
        row: Of the piece before.
        cause: Of the bound that was found last; `axis` likewise.
        end: Where the pieces at hand end.
    """

    pending_s: float
    pending_mm: float
    joint2: float
    joint_cause: int
    joint_axis: int
    known2: float
    row: int
    cause: int
    axis: int
    end: int


def add(parts: Floats, n: int, cause: int, axis: int, seconds: float, way: float) -> None:
    """Count seconds and way for a cause, of one axis or of none."""
    at = 2 * (cause * (n + 1) + axis + 1)
    parts[at] += seconds
    parts[at + 1] += way


def wait(ledger: Ledger, seconds: float, way: float) -> None:
    """Count them for what comes next."""
    ledger.pending_s += seconds
    ledger.pending_mm += way


def resolve(parts: Floats, n: int, ledger: Ledger, cause: int, axis: int) -> None:
    """What the axes have braked for is known."""
    if ledger.pending_s > 0.0 or ledger.pending_mm > 0.0:
        add(parts, n, cause, axis, ledger.pending_s, ledger.pending_mm)
        ledger.pending_s = ledger.pending_mm = 0.0

"""How controls compensate: differences as data. The engine knows no control; each states its own `Policy`.

`N` stands for the number of blocks that a control reads before it executes the first of them. FANUC 0i-TF
Plus 5.4.3 and 5.4.6 state what follows from it: the intersection at a block's end is possible while at most
N - 2 blocks without motion lie between, the interference check while at most N - 3 do. The engine gets both
from one rule: *a block is executed as soon as it and N - 1 more blocks have been read*.
"""

from __future__ import annotations

from enum import Enum

from polycnc.deferred.records import dataclass, field
from polycnc.geometry.offset import Outer


class Approach(Enum):
    """Where start-up ends and cancel begins at an outer corner; at inner corners all are square."""

    #: Square on the contour (FANUC type A, SINUMERIK NORM).
    SQUARE = "square"
    #: As if the start-up block itself were compensated (FANUC type B).
    CORNER = "corner"
    #: As `CORNER`, for the line that touches the tool circle about the corner (SINUMERIK KONT).
    TANGENT = "tangent"
    #: Square on the contour, on a polynomial that has the tangent of the contour's parallel there (SINUMERIK KONTT).
    BENT = "bent"
    #: As `BENT`, with its curvature too (SINUMERIK KONTC).
    CURVED = "curved"


#: Approaches on a polynomial.
BENDS = (Approach.BENT, Approach.CURVED)


class Violation(Enum):
    """What can be wrong with compensation. A control maps those that it checks to its alarm codes."""

    ARC_START = "arc in the start-up block"
    ARC_CANCEL = "arc in the cancel block"
    INNER_RADIUS_TOO_SMALL = "tool radius larger than the radius of an inner arc, or an arc without radius"
    NO_INTERSECTION = "the offset paths of two blocks do not meet"
    INTERFERENCE = "the compensated path runs against the programmed one"
    NO_AVOIDANCE = "no path leads round the interference"
    AVOIDANCE_DANGEROUS = "the path round the interference would cut the workpiece"
    AVOIDANCE_INTERFERES = "the path round the interference interferes again"


@dataclass(frozen=True, slots=True)
class Policy:
    """The behaviour of one control, or of one setting of it.

    Attributes:
        approach: Start-up and cancel with motion.
        shifts_without_motion: A start-up or cancel block without motion shifts the tool by the radius (C).
        blind_start_is_square: A start-up block whose next plane motion lies beyond the look-ahead ends
            square on itself; otherwise it gets no offset and the next plane motion is the start-up.
        outer: Outer corners.
        least_move_mm: Corner motion up to this length is left out (FANUC 5010).
        read_blocks: N, the blocks read until the first of them is executed, itself included.
        start_blocks: The same from a start-up block on; None for as many.
        recommand_is_square: G41 or G42 written again on the same side makes the block in front end square.
        sign_is_side: A radius of the other sign within compensation changes the side where its block begins (FANUC);
            else it holds from the end of its block, as every new radius does (SYNTEC).
        side_change_is_square: Where the side changes, or is commanded anew with a radius of the other sign, the block
            in front ends square on its old side and the next one begins square on its new side, with a line between
            (SINUMERIK); else they meet, or the old one ends square on the next one (FANUC).
        checks_direction: Interference is where a compensated line or arc runs against the programmed (5008).
        checks_arcs: The same for arcs alone.
        avoids: Interference is led round where possible, past any of the blocks read (FANUC 19607#5, 5.4.6.3);
            otherwise it is an alarm.
        leaves_out_arcs: An inner arc too small for the tool is left out where the blocks beside it meet (SINUMERIK);
            else, and where they do not, its chord takes its place.
        dares: A dangerous way round an interference is taken without an alarm (19607#6).
        bare_cancel_is_square: A G40 without motion makes the block in front end square, whatever `approach` says of
            the move that leads back behind it (FANUC types A and B, 5.4.4).
        approaches_behind_stops: Where nothing was known of the next move when one had to be executed, a straight
            block of its own leads to square on the next one (SINUMERIK, `$AC_BLOCKTYPEINFO` 4001); else that one
            begins where the tool stands, square on the one in front.
    """

    approach: Approach = Approach.SQUARE
    shifts_without_motion: bool = False
    blind_start_is_square: bool = True
    outer: Outer = field(default_factory=Outer)
    least_move_mm: float = 0.001
    read_blocks: int = 3
    start_blocks: int | None = None
    recommand_is_square: bool = False
    sign_is_side: bool = True
    side_change_is_square: bool = False
    checks_direction: bool = True
    checks_arcs: bool = True
    avoids: bool = False
    leaves_out_arcs: bool = False
    dares: bool = False
    bare_cancel_is_square: bool = False
    approaches_behind_stops: bool = False

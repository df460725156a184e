"""How controls compensate the radius in space: differences as data."""

from __future__ import annotations

from polycnc.deferred.records import dataclass

INTERSECTION, INTERSECTION_FIRST, ARC_FIRST = 0, 1, 2
#: The tool turns at a corner: not at all, before the arc about it, or along with it.
TURNS_NOT, TURNS_BEFORE, TURNS_ALONG = 0, 1, 2


@dataclass(frozen=True, slots=True)
class Corners:
    """How outer corners are passed, and the corner angles of the work at which the way changes (degrees).

    Attributes:
        way: What is done first.
        least_intersection_deg: Sharper corners get an arc where intersections come first.
        most_arc_deg: Wider corners get an intersection where arcs come first.
        cut_off: In place of an arc both parallels go on by the radius, and a line joins them (FANUC).
    """

    way: int = INTERSECTION
    least_intersection_deg: float = 0.0
    most_arc_deg: float = 180.0
    cut_off: bool = False

    def is_round(self, angle_deg: float) -> bool:
        """Whether a corner of the work with this angle gets an arc, or the line that stands for it."""
        if self.way == INTERSECTION_FIRST:
            return angle_deg < self.least_intersection_deg
        return self.way == ARC_FIRST and angle_deg <= self.most_arc_deg


@dataclass(frozen=True, slots=True)
class Rules:
    """How controls differ.

    Attributes:
        no_corner: Alarm where two blocks have no corner.
        changes: Alarm where a turn of the tool makes an inner corner an outer one; empty where none does.
        idle: Alarm for too many blocks that cannot be computed, and how many may be; empty for no limit.
        most_idle: That number.
        square_start: The first block leads square onto the second one.
        corner_ends: At outer corners the first and the last block count as compensated ones instead (FANUC type B).
        turns: When the tool turns at an outer corner.
        no_room: Alarm for an inner arc that is smaller than the tool; empty where none may come.
        reverses: Alarm for a straight block that the tool would go backwards; empty where nobody checks that.
        slanted: Alarm for an arc that has no parallel arc, for it does not lie square on the tool; empty where it goes
            in chords.
        rounds_ends: Where the path turns back on itself the tool goes round its end (FANUC); else that is no corner.
        crosses: Where the side changes, the tool goes to where both parallels meet, else square on the next block
            (FANUC); otherwise the block in front ends square.
        follows_turns: Where the tool turns along a straight block, its tip goes in chords that keep as far beside
            the path; where nothing leads the axes it goes straight.
    """

    no_corner: str
    changes: str = ""
    idle: str = ""
    most_idle: int = 0
    square_start: bool = False
    corner_ends: bool = False
    turns: int = TURNS_NOT
    no_room: str = ""
    reverses: str = ""
    slanted: str = ""
    rounds_ends: bool = False
    crosses: bool = False
    follows_turns: bool = True

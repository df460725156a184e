"""Straight moves of a tool's tip that are certain to stay within the travel of the axes, for the scanner.

The interpreter looks along the way of every move, for the axes behind a tip go along curves. Here both ends of a row
must lie within the travel by more than the way can bow between them: with a the angle by which the joints of a chain
turn, r the farthest that they carry a point and d the way of the tip, `(a²·r + 2·a·d)/8`. What is nearer to a limit,
the interpreter decides.
"""

from __future__ import annotations

from math import sqrt

from polycnc.kernels.layout import Bytes, Floats
from polycnc.toolpath.kinds import Kind
from polycnc.transformation.orientation.linkage import (
    JOINT_WIDTH,
    RADIAN,
    Block,
    Linkage,
    Room,
    joints_of,
    point_on,
    set_turns,
    tip_on_table,
)

STRAIGHT_KIND = int(Kind.FEED)
#: What positions may differ by from the interpreter's, mm or degrees.
NEARLY = 1e-6


def rows_within(
    kinds: Bytes,
    ends: Floats,
    rows: int,
    start: Floats,
    linkage: Floats,
    offsets: Floats,
    low: Floats,
    high: Floats,
    room: Floats,
    unit: Floats,
) -> int:
    """How many rows from the first on are straight and certain to stay within the travel.

    Args:
        kinds: Of the rows.
        ends: Their ends, work coordinates, n numbers each.
        rows: How many there are.
        start: Where the first one begins; afterwards where the last one found ends.
        linkage: How the axes follow the tip.
        offsets: What is added to positions behind it: of the linear axes, and of the others as they are programmed.
        low: Lowest machine positions.
        high: Highest ones.
        room: For what is worked out.
        unit: Likewise, n numbers.
    """
    n = len(start)
    for row in range(rows):
        if kinds[row] > STRAIGHT_KIND:
            return row
        for i in range(n):
            room[Room.BLOCKS + Block.ORIGIN * n + i] = start[i]
            unit[i] = ends[row * n + i] - start[i]
        bow = NEARLY + bow_of(linkage, n, room, unit)
        for end in range(2):
            if not stands_within(linkage, n, room, unit, float(end), bow, offsets, low, high):
                return row
        for i in range(n):
            start[i] = ends[row * n + i]
    return rows


def bow_of(linkage: Floats, n: int, room: Floats, way: Floats) -> float:
    """How far the linear axes can leave the straight line between the ends of a way that begins at ORIGIN."""
    tables = int(linkage[Linkage.TABLES])
    x, y, z, dx, dy, dz = tip_on_table(linkage, n, room, way, 0.0)
    moved = sqrt(dx * dx + dy * dy + dz * dz)
    table_reach = sqrt(x * x + y * y + z * z) + moved
    x, y, z = linkage[Linkage.TIP], linkage[Linkage.TIP + 1], linkage[Linkage.TIP + 2]
    head_reach = sqrt(x * x + y * y + z * z)
    table_turn = head_turn = 0.0
    for joint in range(joints_of(linkage)):
        at = Linkage.JOINTS + JOINT_WIDTH * joint
        x, y, z = linkage[at + 4], linkage[at + 5], linkage[at + 6]
        offset, turned = sqrt(x * x + y * y + z * z), abs(way[int(linkage[at])]) * RADIAN
        if joint < tables:
            table_reach, table_turn = table_reach + offset, table_turn + turned
        else:
            head_reach, head_turn = head_reach + offset, head_turn + turned
    bow = (
        table_turn * table_turn * table_reach + 2.0 * table_turn * moved + head_turn * head_turn * head_reach
    )
    return 0.125 * bow


def stands_within(
    linkage: Floats,
    n: int,
    room: Floats,
    way: Floats,
    share: float,
    margin: float,
    offsets: Floats,
    low: Floats,
    high: Floats,
) -> bool:
    """Whether the axes stand within their travel by a margin, at a share of a way from ORIGIN."""
    set_turns(linkage, n, room, way, share)
    tables, joints = int(linkage[Linkage.TABLES]), joints_of(linkage)
    x, y, z, dx, dy, dz = tip_on_table(linkage, n, room, way, share)
    if tables > 0:
        x, y, z, dx, dy, dz = point_on(linkage, room, 0, tables - 1, x, y, z, dx, dy, dz)
        at = Linkage.JOINTS + JOINT_WIDTH * (tables - 1) + 4
        x, y, z = x + linkage[at], y + linkage[at + 1], z + linkage[at + 2]
    u, v, w = linkage[Linkage.TIP], linkage[Linkage.TIP + 1], linkage[Linkage.TIP + 2]
    if joints > tables:
        u, v, w, dx, dy, dz = point_on(linkage, room, tables, joints - 1, u, v, w, 0.0, 0.0, 0.0)
    for joint in range(tables, joints):
        at = Linkage.JOINTS + JOINT_WIDTH * joint + 4
        if joint == joints - 1:
            u, v, w = u + linkage[at], v + linkage[at + 1], w + linkage[at + 2]
        u, v, w = u - linkage[at], v - linkage[at + 1], w - linkage[at + 2]
    place = Room.BLOCKS + Block.FIRST * n
    for i in range(n):
        room[place + i] = room[Room.BLOCKS + Block.ORIGIN * n + i] + share * way[i]
    for j in range(3):
        column = int(linkage[Linkage.GEOMETRY + j])
        room[place + column] = x - u if j == 0 else y - v if j == 1 else z - w
    for i in range(n):
        value = room[place + i] + offsets[i]
        if not low[i] + margin <= value <= high[i] - margin:
            return False
    return True

"""How the axes follow the tip, in a form that kernels read: derivatives along a straight path.

`linked.linkage_of` writes a tool centre point, with the frame in front of it, as one flat array. The kernels work out
where a joint carries a point, and how that changes along a path on which the tip and the rotary axes go evenly: with R
the turn of a joint about k and w how far it turns along a unit of the path, `(R p)' = R p' + w·k × R p`.
"""

from __future__ import annotations

from math import cos, pi, sin

from polycnc.kernels.layout import Floats, Places, place

#: Joints that a linkage has room for; longer chains have none.
MOST_JOINTS = 6
#: Numbers of a joint: column of its axis, direction, offset from the joint before.
JOINT_WIDTH = 7
RADIAN = pi / 180.0
#: A tip that goes less than this (mm) stands: it comes from turns of the table, there and back.
STANDS_MM = 1e-6


class Linkage(Places):
    """The record of a transformation: n numbers stand behind ADDED, what is added to each column in front of it.

    The joints of the table come first, then those of the head, of each chain the one at its end first. FRAME are nine
    numbers by rows, then the shift; TIP leads from the last joint of the head to the tip.
    """

    TABLES = place()
    HEADS = place()
    GEOMETRY = place(3)
    TIP = place(3)
    FRAME = place(12)
    JOINTS = place(JOINT_WIDTH * MOST_JOINTS)
    ADDED = place(0)


class Room(Places):
    """What the kernels work out: blocks of n numbers behind BLOCKS, see `Block`.

    TURNS are cosine, sine and radians along a unit of the path, of each joint.
    """

    TURNS = place(3 * MOST_JOINTS)
    BLOCKS = place(0)


class Block(Places):
    """Blocks of n numbers in a `Room`.

    ORIGIN is where a path begins, in work coordinates. FIRST, SECOND and THIRD are the derivatives of the real axes
    along it. PULLS is how much acceleration the columns ask of each of them when all use what they have; JOLTS is the
    same of the jerk, CHANGES how much of PULLS changes along a unit of the path.
    """

    ORIGIN = place()
    FIRST = place()
    SECOND = place()
    THIRD = place()
    PULLS = place()
    JOLTS = place()
    CHANGES = place()


def room_for(n: int) -> int:
    """Numbers of a room for n axes."""
    return Room.BLOCKS + Block.SIZE * n


def joints_of(linkage: Floats) -> int:
    """Number of joints, of the table and of the head."""
    return int(linkage[Linkage.TABLES]) + int(linkage[Linkage.HEADS])


def turned_by(linkage: Floats, way: Floats) -> float:
    """How far all joints turn together on a way of the columns, degrees."""
    total = 0.0
    for joint in range(joints_of(linkage)):
        total += abs(way[int(linkage[Linkage.JOINTS + JOINT_WIDTH * joint])])
    return total


def set_turns(linkage: Floats, n: int, room: Floats, unit: Floats, way: float) -> None:
    """Set TURNS for the point at a way from ORIGIN along `unit`."""
    for joint in range(joints_of(linkage)):
        column = int(linkage[Linkage.JOINTS + JOINT_WIDTH * joint])
        angle = room[Room.BLOCKS + Block.ORIGIN * n + column] + way * unit[column]
        angle = (angle + linkage[Linkage.ADDED + column]) * RADIAN
        at = Room.TURNS + 3 * joint
        room[at], room[at + 1], room[at + 2] = cos(angle), sin(angle), unit[column] * RADIAN


def across(linkage: Floats, joint: int, x: float, y: float, z: float) -> tuple[float, float, float]:
    """The cross product of a joint's direction and a vector."""
    at = Linkage.JOINTS + JOINT_WIDTH * joint + 1
    a, b, c = linkage[at], linkage[at + 1], linkage[at + 2]
    return b * z - c * y, c * x - a * z, a * y - b * x


def turned(
    linkage: Floats, room: Floats, joint: int, x: float, y: float, z: float
) -> tuple[float, float, float]:
    """A vector as a joint turns it."""
    at = Linkage.JOINTS + JOINT_WIDTH * joint + 1
    c, s = room[Room.TURNS + 3 * joint], room[Room.TURNS + 3 * joint + 1]
    a, b, d = linkage[at], linkage[at + 1], linkage[at + 2]
    along = (a * x + b * y + d * z) * (1.0 - c)
    u, v, w = across(linkage, joint, x, y, z)
    return c * x + s * u + along * a, c * y + s * v + along * b, c * z + s * w + along * d


def through(
    linkage: Floats,
    room: Floats,
    first: int,
    last: int,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
) -> tuple[float, float, float, float, float, float]:
    """A direction and its derivative, as the joints from `first` to before `last` turn them."""
    for joint in range(first, last):
        w = room[Room.TURNS + 3 * joint + 2]
        x, y, z = turned(linkage, room, joint, x, y, z)
        dx, dy, dz = turned(linkage, room, joint, dx, dy, dz)
        ux, uy, uz = across(linkage, joint, x, y, z)
        dx, dy, dz = dx + w * ux, dy + w * uy, dz + w * uz
    return x, y, z, dx, dy, dz


def point_on(
    linkage: Floats,
    room: Floats,
    first: int,
    last: int,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
) -> tuple[float, float, float, float, float, float]:
    """A point and its derivative, as the joints from `first` to `last` carry it, without the offset of the last."""
    for joint in range(first, last + 1):
        x, y, z, dx, dy, dz = through(linkage, room, joint, joint + 1, x, y, z, dx, dy, dz)
        if joint < last:
            at = Linkage.JOINTS + JOINT_WIDTH * joint + 4
            x, y, z = x + linkage[at], y + linkage[at + 1], z + linkage[at + 2]
    return x, y, z, dx, dy, dz


def derivatives(
    linkage: Floats,
    room: Floats,
    first: int,
    last: int,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
) -> tuple[float, float, float, float, float, float, float, float, float]:
    """First, second and third derivative of a point that goes evenly, as the joints from `first` on carry it."""
    ex, ey, ez, fx, fy, fz = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for joint in range(first, last):
        w = room[Room.TURNS + 3 * joint + 2]
        x, y, z = turned(linkage, room, joint, x, y, z)
        dx, dy, dz = turned(linkage, room, joint, dx, dy, dz)
        ex, ey, ez = turned(linkage, room, joint, ex, ey, ez)
        fx, fy, fz = turned(linkage, room, joint, fx, fy, fz)
        # Once and twice across the joint's direction: of p, of p' and of p''.
        ux, uy, uz = across(linkage, joint, x, y, z)
        vx, vy, vz = across(linkage, joint, ux, uy, uz)
        px, py, pz = across(linkage, joint, dx, dy, dz)
        qx, qy, qz = across(linkage, joint, px, py, pz)
        rx, ry, rz = across(linkage, joint, ex, ey, ez)
        w2, w3 = w * w, w * w * w
        fx += 3.0 * w * rx + 3.0 * w2 * qx - w3 * ux
        fy += 3.0 * w * ry + 3.0 * w2 * qy - w3 * uy
        fz += 3.0 * w * rz + 3.0 * w2 * qz - w3 * uz
        ex, ey, ez = ex + 2.0 * w * px + w2 * vx, ey + 2.0 * w * py + w2 * vy, ez + 2.0 * w * pz + w2 * vz
        dx, dy, dz = dx + w * ux, dy + w * uy, dz + w * uz
        at = Linkage.JOINTS + JOINT_WIDTH * joint + 4
        x, y, z = x + linkage[at], y + linkage[at + 1], z + linkage[at + 2]
    return dx, dy, dz, ex, ey, ez, fx, fy, fz


def tip_on_table(
    linkage: Floats, n: int, room: Floats, unit: Floats, way: float
) -> tuple[float, float, float, float, float, float]:
    """The tip at a way from ORIGIN along `unit`, seen from the innermost joint of the table, and its derivative."""
    origin, gx = Room.BLOCKS + Block.ORIGIN * n, int(linkage[Linkage.GEOMETRY])
    gy, gz = int(linkage[Linkage.GEOMETRY + 1]), int(linkage[Linkage.GEOMETRY + 2])
    x, dx = room[origin + gx] + way * unit[gx], unit[gx]
    y, dy = room[origin + gy] + way * unit[gy], unit[gy]
    z, dz = room[origin + gz] + way * unit[gz], unit[gz]
    f = Linkage.FRAME
    u = (
        linkage[f] * x
        + linkage[f + 1] * y
        + linkage[f + 2] * z
        + linkage[f + 9]
        + linkage[Linkage.ADDED + gx]
    )
    v = linkage[f + 3] * x + linkage[f + 4] * y + linkage[f + 5] * z + linkage[f + 10]
    w = linkage[f + 6] * x + linkage[f + 7] * y + linkage[f + 8] * z + linkage[f + 11]
    v, w = v + linkage[Linkage.ADDED + gy], w + linkage[Linkage.ADDED + gz]
    for joint in range(int(linkage[Linkage.TABLES])):
        at = Linkage.JOINTS + JOINT_WIDTH * joint + 4
        u, v, w = u - linkage[at], v - linkage[at + 1], w - linkage[at + 2]
    return (
        u,
        v,
        w,
        linkage[f] * dx + linkage[f + 1] * dy + linkage[f + 2] * dz,
        linkage[f + 3] * dx + linkage[f + 4] * dy + linkage[f + 5] * dz,
        linkage[f + 6] * dx + linkage[f + 7] * dy + linkage[f + 8] * dz,
    )


def derive(linkage: Floats, n: int, room: Floats, unit: Floats, way: float) -> None:
    """Set FIRST, SECOND and THIRD for the point at a way from ORIGIN along `unit`; TURNS are set."""
    tables, joints = int(linkage[Linkage.TABLES]), joints_of(linkage)
    first, second, third = (
        Room.BLOCKS + Block.FIRST * n,
        Room.BLOCKS + Block.SECOND * n,
        Room.BLOCKS + Block.THIRD * n,
    )
    for i in range(n):
        room[first + i], room[second + i], room[third + i] = unit[i], 0.0, 0.0
    x, y, z, dx, dy, dz = tip_on_table(linkage, n, room, unit, way)
    work = derivatives(linkage, room, 0, tables, x, y, z, dx, dy, dz)
    x, y, z = linkage[Linkage.TIP], linkage[Linkage.TIP + 1], linkage[Linkage.TIP + 2]
    tool = derivatives(linkage, room, tables, joints, x, y, z, 0.0, 0.0, 0.0)
    for j in range(3):
        column = int(linkage[Linkage.GEOMETRY + j])
        room[first + column] = work[j] - tool[j]
        room[second + column] = work[3 + j] - tool[3 + j]
        room[third + column] = work[6 + j] - tool[6 + j]


def ask(
    linkage: Floats,
    n: int,
    room: Floats,
    unit: Floats,
    way: float,
    pulls: Floats,
    jolts: Floats,
) -> None:
    """Set PULLS, JOLTS and CHANGES for the point at a way from ORIGIN along `unit`; TURNS are set.

    Columns of the tip, and others that move, ask for `pulls` and `jolts`.
    """
    tables, joints = int(linkage[Linkage.TABLES]), joints_of(linkage)
    pull, jolt, change = (
        Room.BLOCKS + Block.PULLS * n,
        Room.BLOCKS + Block.JOLTS * n,
        Room.BLOCKS + Block.CHANGES * n,
    )
    for i in range(n):
        moves = unit[i] != 0.0
        room[pull + i] = pulls[i] if moves else 0.0
        room[jolt + i], room[change + i] = jolts[i] if moves else 0.0, 0.0
    for j in range(3):
        column = int(linkage[Linkage.GEOMETRY + j])
        room[pull + column], room[jolt + column] = 0.0, 0.0
    f = Linkage.FRAME
    for j in range(3):
        a, b, c = linkage[f + j], linkage[f + 3 + j], linkage[f + 6 + j]
        x, y, z, dx, dy, dz = through(linkage, room, 0, tables, a, b, c, 0.0, 0.0, 0.0)
        column = int(linkage[Linkage.GEOMETRY + j])
        add_asked(linkage, n, room, x, y, z, dx, dy, dz, pulls[column], jolts[column])
    u, v, w, du, dv, dw = tip_on_table(linkage, n, room, unit, way)
    for joint in range(joints):
        column = int(linkage[Linkage.JOINTS + JOINT_WIDTH * joint])
        if unit[column] != 0.0:
            if joint < tables:
                x, y, z, dx, dy, dz = point_on(linkage, room, 0, joint, u, v, w, du, dv, dw)
            else:
                x, y, z = linkage[Linkage.TIP], linkage[Linkage.TIP + 1], linkage[Linkage.TIP + 2]
                x, y, z, dx, dy, dz = point_on(linkage, room, tables, joint, x, y, z, 0.0, 0.0, 0.0)
            x, y, z = across(linkage, joint, x, y, z)
            dx, dy, dz = across(linkage, joint, dx, dy, dz)
            last = tables if joint < tables else joints
            x, y, z, dx, dy, dz = through(linkage, room, joint + 1, last, x, y, z, dx, dy, dz)
            own, jolted = RADIAN * pulls[column], RADIAN * jolts[column]
            add_asked(linkage, n, room, x, y, z, dx, dy, dz, own, jolted)


def add_asked(
    linkage: Floats,
    n: int,
    room: Floats,
    x: float,
    y: float,
    z: float,
    dx: float,
    dy: float,
    dz: float,
    pull: float,
    jolt: float,
) -> None:
    """Add what a column asks of the linear axes that carries them along (x, y, z), which changes by its derivative."""
    gx, gy, gz = (
        int(linkage[Linkage.GEOMETRY]),
        int(linkage[Linkage.GEOMETRY + 1]),
        int(linkage[Linkage.GEOMETRY + 2]),
    )
    at = Room.BLOCKS + Block.PULLS * n
    room[at + gx] += abs(x) * pull
    room[at + gy] += abs(y) * pull
    room[at + gz] += abs(z) * pull
    at = Room.BLOCKS + Block.JOLTS * n
    room[at + gx] += abs(x) * jolt
    room[at + gy] += abs(y) * jolt
    room[at + gz] += abs(z) * jolt
    at = Room.BLOCKS + Block.CHANGES * n
    room[at + gx] += abs(dx) * pull
    room[at + gy] += abs(dy) * pull
    room[at + gz] += abs(dz) * pull

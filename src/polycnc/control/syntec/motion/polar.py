"""Polar coordinate interpolation G12.1 / G13.1: X and C become a Cartesian plane (manual 2.15).

The contour is written as if X and C were the two axes of G17; the linear axis follows by the distance from the rotation
centre, the rotary one by the angle. The angle of C at G12.1 is the direction of the first axis. G10 L1301 does the same
with any pair of axes, in the plane that a block with G17, G18 or G19 has made of them.
"""

from __future__ import annotations

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.syntec.coordinates.diameters import DiameterState
from polycnc.control.word_address.states import PolarState
from polycnc.control.word_address.tools.radius import RadiusState
from polycnc.control.word_address.transformations.polar_interpolation import (
    GROUP,
    PLANE_OF_LINEAR,
    enter_polar,
    leave_polar,
)
from polycnc.deferred.functions import loaded_when_called
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES

with loaded_when_called():
    from polycnc.transformation.kinematic.polar import PolarPlane

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.plan import Builder
    from polycnc.control.word_address.block.words import Words
    from polycnc.transformation.contract import Geometry

POLAR = GROUP
LINEAR, ROTARY = "X", "C"
#: What must not come inside: it would change the coordinate system or leave it (2.15.2, notes 5, 12 and 16).
FORBIDDEN = frozenset({
    "G28", "G28.1", "G29", "G30", "G31", "G31.10", "G31.11", "G50", "G50.1", "G51", "G51.1", "G52", "G53", "G53.1",
    "G53.3", "G53.6", "G54", "G54.4", "G55", "G56", "G57", "G58", "G59", *(f"G59.{i}" for i in range(1, 10)), "G68",
    "G68.2", "G68.3", "G92", "G92.1", "G43.4", "G43.5",
})  # fmt: skip


@dataclass(slots=True)
class BlockStart(State, lifetime=Lifetime.RESET):
    """Where the last move ended (#1411 on) while G12.1 or G10 L1301 alone have named the place anew.

    Attributes:
        named: Coordinates that the axes had, diameters where they were displayed; empty while nothing has begun.
        renamed: Coordinates of the same place in the polar plane.
    """

    named: tuple[float, ...] = ()
    renamed: tuple[float, ...] = ()


def start_polar(channel: SyntecChannel, words: Words) -> None:
    """G12.1 [X] [C]: the plane of X and C; X and C are the program zero against the rotation centre."""
    linear, rotary = (channel.axis_index.get(name, -1) for name in (LINEAR, ROTARY))
    if linear < 0 or rotary < 0 or not channel.axis_data[rotary].rotary:
        raise words.fail("polar_axes", "G12.1")
    eccentricity = (words.length("X") or 0.0, words.length("C") or 0.0)
    _enter(channel, words, linear, rotary, ("G17", _geometry(channel, "G17", linear, rotary), eccentricity))


def switch_polar(channel: SyntecChannel, words: Words) -> None:
    """G10 L1301 X C I J R1: polar interpolation with the axes of the numbers X (linear) and C (rotary); R0 ends it.

    I and J are the program zero against the rotation centre, along both axes of the plane (2.15, appendix 1).
    """
    switch = words.typed("R")
    if switch not in (0, 1):
        raise words.fail("argument" if switch is None else "number", "R" if switch is not None else "G10")
    if switch == 0:
        end_polar(channel, words)
        return
    numbers = [words.typed(letter) for letter in "XC"]
    for letter, number in zip("XC", numbers, strict=True):
        if number is None or number != int(number) or not 1 <= number <= len(channel.axes):
            raise words.fail("argument", letter)
    linear, rotary = (int(number or 0) - 1 for number in numbers)
    if channel.axis_data[linear].rotary or not channel.axis_data[rotary].rotary:
        raise words.fail("polar_axes", "G10")
    eccentricity = (words.length("I") or 0.0, words.length("J") or 0.0)
    plane, geometry = channel.mode["plane"], channel.coordinates.geometry
    if {geometry[place] for place in PLANES[plane][:2]} != {linear, rotary}:
        plane = PLANE_OF_LINEAR[geometry.index(linear)] if linear in geometry else "G17"
        geometry = _geometry(channel, plane, linear, rotary)
    _enter(channel, words, linear, rotary, (plane, geometry, eccentricity))


def _geometry(channel: SyntecChannel, plane: str, linear: int, rotary: int) -> Geometry:
    """Columns of X, Y and Z where a plane is made of two axes."""
    u, v, _ = PLANES[plane]
    columns = list(channel.coordinates.geometry)
    columns[u], columns[v] = linear, rotary
    return columns[0], columns[1], columns[2]


def _enter(
    channel: SyntecChannel,
    words: Words,
    linear: int,
    rotary: int,
    placed: tuple[str, Geometry, tuple[float, float]],
) -> None:
    """From here on words name points of the plane of two axes; nothing moves.

    `placed`: code of the plane, columns of X, Y and Z in it, program zero against the rotation centre.
    """
    c, (plane, geometry, eccentricity) = channel.coordinates, placed
    if RadiusState.of(channel).side or not (c.direct and c.zero.is_identity):
        raise words.fail("polar_mode", "G12.1")
    active = PolarState.of(channel).plane
    if active is not None:
        if (active.linear, active.rotary) != (linear, rotary):
            raise words.fail("polar_mode", "G12.1")
        return
    channel.flush()
    here = c.position
    side = -1.0 if here[linear] < 0.0 else 1.0
    diameter = channel.memory.is_diameter(linear)
    DiameterState.of(channel).switched[linear] = False
    polar = PolarPlane(linear, rotary, geometry, here[rotary], eccentricity, side, pole_deg=here[rotary])
    channel.mode = channel.mode.with_code(POLAR, "G12.1")
    enter_polar(channel, polar, plane, diameter=diameter)
    start = BlockStart.of(channel)
    shown = {linear: 2.0 * here[linear]} if diameter else {}
    start.named = tuple(shown.get(axis, value) for axis, value in enumerate(here))
    start.renamed = tuple(c.position)


def block_start(channel: SyntecChannel) -> list[float]:
    """Where the last move ended, as it was displayed then, mm or degrees (#1411 on)."""
    start, here = BlockStart.of(channel), channel.coordinates.position
    if PolarState.of(channel).plane is not None and tuple(here) == start.renamed:
        return list(start.named)
    return here


def plane_code(plane: PolarPlane) -> str:
    """Which of G17, G18 and G19 the axes of the plane span."""
    own = {plane.geometry.index(plane.linear), plane.geometry.index(plane.rotary)}
    return next(code for code, places in PLANES.items() if set(places[:2]) == own)


def end_polar(channel: SyntecChannel, words: Words) -> None:
    """G13.1: X and C are axes of their own again; the former plane and the parameter's kind of X return."""
    if PolarState.of(channel).plane is None:
        return
    if RadiusState.of(channel).side:
        raise words.fail("polar_mode", "G13.1")
    channel.flush()
    channel.mode = channel.mode.with_code(POLAR, "G13.1")
    leave_plane(channel)


def leave_plane(channel: SyntecChannel) -> None:
    """The axes are named themselves again; nothing moves."""
    plane = PolarState.of(channel).plane
    if plane is not None:
        DiameterState.of(channel).switched.pop(plane.linear, None)
        leave_polar(channel)


def check_block(builder: Builder) -> None:
    """Refuse codes that polar interpolation does not allow."""
    if builder.before[POLAR] != "G12.1":
        return
    for row in builder.codes:
        if row.code in FORBIDDEN:
            raise builder.control.fail("polar_mode", address=row.code)
        if row.code == "G10.9":
            raise builder.control.fail("polar_diameter", address=row.code)

"""A tool centre point, with the frame in front of it, as the flat array that kernels read (`linkage`)."""

from __future__ import annotations

from array import array
from math import dist, hypot

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY
from polycnc.transformation.orientation.linkage import JOINT_WIDTH, MOST_JOINTS, RADIAN, Linkage
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.transformation.contract import Transformation
    from polycnc.transformation.orientation.tool_centre import Link


def linkage_of(transformation: Transformation | None) -> array[float]:
    """The record of a transformation; empty for one that is no tool centre point, has too many joints or couplings."""
    seated = transformation if isinstance(transformation, Seated) else None
    point = transformation if seated is None else seated.inner
    if (seated is not None and seated.is_coupled) or not isinstance(point, ToolCentrePoint):
        return array("d")
    tables, heads = point.chains
    if len(tables) + len(heads) > MOST_JOINTS or any(
        link.column in point.geometry for link in (*tables, *heads)
    ):
        return array("d")
    record = array("d", bytes(8 * (Linkage.ADDED + len(point.axes))))
    record[Linkage.TABLES], record[Linkage.HEADS] = len(tables), len(heads)
    _write(record, Linkage.GEOMETRY, point.geometry)
    _write(record, Linkage.TIP, point.hung)
    frame = IDENTITY if seated is None else seated.frame
    _write(record, Linkage.FRAME, (*frame.m[0], *frame.m[1], *frame.m[2], *frame.t))
    for number, link in enumerate((*tables, *heads)):
        _write(record, Linkage.JOINTS + JOINT_WIDTH * number, _joint(link))
    shifts = seated.shifts if seated is not None and seated.shifts else (0.0,) * len(point.axes)
    _write(record, Linkage.ADDED, [a + b for a, b in zip(shifts, point.zero, strict=True)])
    return record


def is_tip(transformation: Transformation | None) -> bool:
    """Whether a transformation is a tool centre point, with a frame in front of it or without."""
    return isinstance(
        transformation.inner if isinstance(transformation, Seated) else transformation, ToolCentrePoint
    )


def zero_of(transformation: Transformation | None, n: int) -> tuple[float, ...]:
    """What is added to each of n axes behind the chains of a tool centre point; zero for other transformations.

    Of a linear axis it is added to the way from the tip to where it stands, of others to the number in the path.
    """
    seated = transformation if isinstance(transformation, Seated) else None
    point = transformation if seated is None else seated.inner
    if not isinstance(point, ToolCentrePoint):
        return (0.0,) * n
    shifts = list(seated.shifts) if seated is not None and seated.shifts else [0.0] * n
    behind = seated.offsets if seated is not None and seated.offsets else (0.0,) * n
    for column, way in zip(point.geometry, point.apart, strict=True):
        shifts[column] = way - point.zero[column]
    return tuple(a + b for a, b in zip(shifts, behind, strict=True))


def ways_behind(
    transformation: Transformation | None, start: Sequence[float], end: Sequence[float], by: Sequence[float]
) -> list[float]:
    """How far axes behind a straight way of the tip are at most from where they are at its end, all along it.

    Its points may be moved by as much as `by` says for each column. Empty for what is no tool centre point, or has
    couplings. A joint takes what it carries along by no more than its turn times how far that is away.
    """
    seated = transformation if isinstance(transformation, Seated) else None
    point = transformation if seated is None else seated.inner
    if (seated is not None and seated.is_coupled) or not isinstance(point, ToolCentrePoint):
        return []
    ends = [list(place) if seated is None else seated.basic(place) for place in (start, end)]
    a, b = ([place[column] + point.zero[column] for column in point.geometry] for place in ends)
    larger = (
        1.0 if seated is None else max(hypot(*row) for row in zip(*seated.frame.m, strict=True)) * 3.0**0.5
    )
    beside = larger * hypot(*(by[column] for column in point.geometry))
    ways = [abs(to - at) + more for at, to, more in zip(*ends, by, strict=True)]
    linear = dist(a, b) + beside
    for links, arm in zip(
        point.chains, (max(hypot(*a), hypot(*b)) + beside, hypot(*point.hung)), strict=True
    ):
        reach = arm + 2.0 * sum(hypot(*link.offset) for link in links)
        linear += reach * RADIAN * sum(ways[link.column] for link in links)
    for column in point.geometry:
        ways[column] = linear
    return ways


def _joint(link: Link) -> Sequence[float]:
    return (link.column, *link.direction, *link.offset)


def _write(record: array[float], at: int, numbers: Sequence[float]) -> None:
    record[at : at + len(numbers)] = array("d", numbers)

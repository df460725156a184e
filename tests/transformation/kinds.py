"""Transformations of every kind with any parameters, and points of the path that they map."""

from __future__ import annotations

from math import hypot
from typing import TYPE_CHECKING

from hypothesis import strategies as st

from polycnc.geometry.frames import IDENTITY, rotation, translation
from polycnc.machine.kinematics import Kinematics
from polycnc.machine.model import Joint
from polycnc.transformation.chain import Chain
from polycnc.transformation.couplings.coupled import Coupled
from polycnc.transformation.couplings.laws import Ratio
from polycnc.transformation.kinematic.cylinder import Cylinder
from polycnc.transformation.kinematic.groove import GrooveCylinder
from polycnc.transformation.kinematic.inclined import InclinedAxis
from polycnc.transformation.kinematic.parallel import ParallelAxes
from polycnc.transformation.kinematic.polar import PolarPlane
from polycnc.transformation.orientation.tool_centre import ToolCentrePoint
from polycnc.transformation.planes.feature import FeatureFrame
from polycnc.transformation.seated import Seated

if TYPE_CHECKING:
    from polycnc.geometry.frames import Vector
    from polycnc.transformation.contract import Transformation

#: Columns of all points: three linear axes, a virtual one, up to three rotary ones.
AXES = ("X", "Y", "Z", "V", "A", "B", "C")
WIDTH, VIRTUAL, ROTARY = len(AXES), 3, (4, 5, 6)
XYZ = (0, 1, 2)

places = st.floats(-500.0, 500.0, allow_subnormal=False)
angles = st.floats(-179.0, 179.0, allow_subnormal=False)
#: The virtual axis is zero, except where a kind makes use of it.
points = st.tuples(places, places, places, st.just(0.0), angles, angles, angles)
_parts = st.integers(-10, 10)
directions = st.tuples(_parts, _parts, _parts).filter(any)
offsets = st.tuples(places, places, places)


def joints(names: str, carries: str) -> st.SearchStrategy[tuple[Joint, ...]]:
    """Rotary joints of a chain, one for each name."""

    def joint(name: str) -> st.SearchStrategy[Joint]:
        return st.builds(
            lambda direction, offset: Joint(name, True, carries, _floats(direction), offset),  # type: ignore[arg-type]
            directions,
            offsets,
        )

    return st.tuples(*(joint(name) for name in names))


def _floats(direction: tuple[int, int, int]) -> Vector:
    x, y, z = direction
    return (float(x), float(y), float(z))


def _kinematics(split: tuple[str, str]) -> st.SearchStrategy[Kinematics]:
    """A head with its nose anywhere, positions that name any point, and a table."""
    nose = offsets if split[0] else st.just((0.0, 0.0, 0.0))
    return st.builds(
        Kinematics, joints(split[0], "tool"), joints(split[1], "work"), st.just((0.0, 0.0, 1.0)), nose, nose
    )


#: Head and table share none to three rotary axes in any way: head/head, table/table, head/table, nutating.
kinematics = st.sampled_from(
    [("", ""), ("A", ""), ("", "C"), ("CA", ""), ("", "AC"), ("B", "C"), ("CAB", ""), ("A", "BC")]
).flatmap(_kinematics)

frames = st.builds(
    lambda i, j, k, shift: translation(*shift) @ rotation(2, i) @ rotation(0, j) @ rotation(2, k),
    angles,
    angles,
    angles,
    offsets,
)
polars = st.builds(
    PolarPlane,
    st.just(0),
    st.just(6),
    st.just((0, 6, 2)),
    angles,
    st.tuples(places, places),
    st.sampled_from([1.0, -1.0]),
    st.just(-1),
    st.none() | angles,
)
cylinders = st.builds(Cylinder.of_radius, st.just(4), st.floats(0.5, 500.0), st.just((0, 4, 2)))
grooves = st.builds(GrooveCylinder, st.just(4), st.just(1), st.floats(0.05, 10.0), st.just(XYZ))
inclined = st.builds(InclinedAxis, st.just(0), st.just(2), st.floats(-80.0, 80.0), st.just(XYZ))
tips = st.builds(
    ToolCentrePoint,
    kinematics,
    st.just(AXES),
    st.just(XYZ),
    st.tuples(*[places] * 4, *[angles] * 3),
    st.tuples(places, places, places),
)
features = st.builds(FeatureFrame, frames, st.just(XYZ))
couplings = st.builds(
    lambda factor, origin, other: Coupled.of({1: [Ratio(0, factor, origin)], 2: [Ratio(1, other)]}, XYZ),
    st.floats(-5.0, 5.0),
    places,
    st.floats(-5.0, 5.0),
)
single: st.SearchStrategy[Transformation] = st.one_of(
    polars, cylinders, grooves, inclined, tips, features, couplings
)
chains: st.SearchStrategy[Transformation] = st.one_of(
    st.builds(lambda *links: Chain(links), polars, inclined),
    st.builds(lambda *links: Chain(links), cylinders, features),
    st.builds(lambda *links: Chain(links), features, tips),
    st.builds(lambda *links: Chain(links), inclined, features, tips),
)
_shifts = st.just(()) | st.tuples(*[places] * 3, st.just(0.0), *[angles] * 3)
seated: st.SearchStrategy[Transformation] = st.one_of(
    st.builds(Seated, tips, frames, _shifts, st.just(())),
    st.builds(Seated, cylinders, st.just(IDENTITY), st.just(()), _shifts),
    st.builds(Seated, inclined, frames, _shifts, _shifts),
    st.builds(Seated, polars, st.builds(lambda shift: translation(*shift), offsets), st.just(()), _shifts),
)
every: st.SearchStrategy[Transformation] = st.one_of(single, chains, seated, st.just(ParallelAxes((1, 0, 2))))


def away_from_pole(transformation: Transformation, point: tuple[float, ...]) -> float:
    """Distance from the pole, mm; where there is none, a large one."""
    pole = transformation.pole
    return 1e9 if pole is None else hypot(*pole.away(point))

"""The data type FRAME: translation (coarse and fine), rotation, scale and mirror, chained with `:`.

A frame maps a point of its inner system to the outer one. On the geometry axes X, Y, Z that is
`p' = coarse + fine + R·S·M·p`; any other axis has a shift, a scale and a mirror of its own. Chains keep the
product of the matrices exactly; the angles and factors that a program reads back are worked out of it:
`R = Rz·Ry·Rx`, angles about X and Z in -180..180, about Y in -90..90 degrees.

Source: job planning 5.2 (frame variables, components), 5.3 (coarse and fine offset).
"""

from __future__ import annotations

from math import asin, atan2, cos, degrees, hypot

from polycnc.deferred.records import dataclass, field, replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import IDENTITY, Frame, Matrix, Vector, rotation, scaling
from polycnc.memory.encoding import encoded

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

GEOMETRY_AXES = ("X", "Y", "Z")
COMPONENTS = ("TR", "FI", "RT", "SC", "MI")
_ZERO: Vector = (0.0, 0.0, 0.0)


@encoded("axis frame")
@dataclass(frozen=True, slots=True)
class AxisFrame:
    """What a frame does to one axis outside the geometry: `outer = coarse + fine + factor * inner`."""

    coarse: float = 0.0
    fine: float = 0.0
    scale: float = 1.0
    mirrored: bool = False

    @property
    def factor(self) -> float:
        """Scale and mirror in one."""
        return -self.scale if self.mirrored else self.scale

    def __matmul__(self, inner: AxisFrame) -> AxisFrame:
        return AxisFrame(
            self.coarse + self.factor * inner.coarse,
            self.fine + self.factor * inner.fine,
            self.scale * inner.scale,
            self.mirrored != inner.mirrored,
        )


@encoded("frame")
@dataclass(frozen=True, slots=True)
class NcFrame:
    """One value of type FRAME. Immutable.

    Attributes:
        matrix: Rotation, scale and mirror of the geometry axes (rows).
        coarse: Translation of the geometry axes, mm.
        fine: Fine translation of the geometry axes, mm.
        mirrored: Which geometry axes count as mirrored.
        others: The part of every other axis that the frame changes, by name.
    """

    matrix: Matrix = IDENTITY.m
    coarse: Vector = _ZERO
    fine: Vector = _ZERO
    mirrored: tuple[bool, bool, bool] = (False, False, False)
    others: Mapping[str, AxisFrame] = field(default_factory=dict)

    @property
    def frame(self) -> Frame:
        """The map of the geometry axes."""
        return Frame(self.matrix, _add(self.coarse, self.fine))

    @property
    def has_rotation(self) -> bool:
        """Whether any geometry axis is turned."""
        return any(abs(angle) > 1e-12 for angle in self.angles)

    @property
    def has_fine(self) -> bool:
        """Whether any axis has a fine offset."""
        return any(self.fine) or any(part.fine for part in self.others.values())

    @property
    def scales(self) -> Vector:
        """Scale factors of the geometry axes: the lengths of the matrix's columns."""
        return _vector(_norm(column) for column in zip(*self.matrix, strict=True))

    @property
    def angles(self) -> Vector:
        """Rotation about X, Y, Z in degrees."""
        signs = [-1.0 if flag else 1.0 for flag in self.mirrored]
        columns = [
            [value * sign / _norm(column) for value in column]
            for column, sign in zip(zip(*self.matrix, strict=True), signs, strict=True)
        ]
        (r00, r10, r20), (r01, r11, r21), (_, _, r22) = columns
        y = asin(max(-1.0, min(1.0, -r20)))
        if cos(y) > 1e-9:
            x, z = atan2(r21, r22), atan2(r10, r00)
        else:
            x, z = 0.0, atan2(-r01, r11)
        return degrees(x), degrees(y), degrees(z)

    def __matmul__(self, inner: NcFrame) -> NcFrame:
        """The chain `self : inner`."""
        linear = Frame(self.matrix)
        names = {*self.others, *inner.others}
        neutral = AxisFrame()
        a, b = self.mirrored, inner.mirrored
        return NcFrame(
            (linear @ Frame(inner.matrix)).m,
            _add(self.coarse, linear.apply(*inner.coarse)),
            _add(self.fine, linear.apply(*inner.fine)),
            (a[0] != b[0], a[1] != b[1], a[2] != b[2]),
            {name: self.others.get(name, neutral) @ inner.others.get(name, neutral) for name in names},
        )

    def inverse(self) -> NcFrame:
        """The frame that undoes this one (INVFRAME); its whole translation is coarse."""
        back = self.frame.inverse()
        others = {
            name: AxisFrame(-(part.coarse + part.fine) / part.factor, 0.0, 1.0 / part.scale, part.mirrored)
            for name, part in self.others.items()
        }
        return NcFrame(back.m, back.t, _ZERO, self.mirrored, others)

    def component(self, axis: str, name: str) -> float:
        """Read `frame[axis, name]`; `name` is one of `COMPONENTS`. MI gives 0 or 1."""
        if axis not in GEOMETRY_AXES:
            part = self.others.get(axis, AxisFrame())
            values = (part.coarse, part.fine, 0.0, part.scale, float(part.mirrored))
            return values[COMPONENTS.index(name)]
        i = GEOMETRY_AXES.index(axis)
        match name:
            case "TR":
                return self.coarse[i]
            case "FI":
                return self.fine[i]
            case "RT":
                return self.angles[i]
            case "SC":
                return self.scales[i]
            case _:
                return float(self.mirrored[i])

    def with_component(self, axis: str, name: str, value: float) -> NcFrame:
        """The frame after `frame[axis, name] = value`.

        Raises:
            ValueError: A rotation of an axis outside the geometry, or a scale of zero.
        """
        if name == "SC" and value == 0.0:
            raise ValueError("scale of zero")
        if axis not in GEOMETRY_AXES:
            if name == "RT":
                raise ValueError("rotation of an axis outside the geometry")
            return replace(self, others={**self.others, axis: _axis_part(self.others.get(axis), name, value)})
        i = GEOMETRY_AXES.index(axis)
        if name == "TR":
            return replace(self, coarse=_set(self.coarse, i, value))
        if name == "FI":
            return replace(self, fine=_set(self.fine, i, value))
        angles, scales, mirrored = self.angles, self.scales, list(self.mirrored)
        if name == "RT":
            angles = _set(angles, i, value)
        elif name == "SC":
            scales = _set(scales, i, value)
        else:
            mirrored[i] = bool(value)
        flags = (mirrored[0], mirrored[1], mirrored[2])
        return replace(self, matrix=_matrix(angles, scales, flags), mirrored=flags)

    def fine_part(self, axes: Iterable[str]) -> NcFrame:
        """The fine translation of some axes alone."""
        return cfine({axis: self.component(axis, "FI") for axis in axes})

    def folded(self) -> NcFrame:
        """The frame with its fine part added to the coarse one, as the programmable frame keeps it (5.3)."""
        others = {n: replace(p, coarse=p.coarse + p.fine, fine=0.0) for n, p in self.others.items()}
        return replace(self, coarse=_add(self.coarse, self.fine), fine=_ZERO, others=others)


NEUTRAL = NcFrame()


def ctrans(shifts: Mapping[str, float]) -> NcFrame:
    """CTRANS: coarse translation by axis."""
    return _build(shifts, "TR")


def cfine(shifts: Mapping[str, float]) -> NcFrame:
    """CFINE: fine translation by axis."""
    return _build(shifts, "FI")


def crot(angles: Mapping[str, float]) -> NcFrame:
    """CROT: rotation about geometry axes, degrees, `Rz·Ry·Rx`."""
    if any(axis not in GEOMETRY_AXES for axis in angles):
        raise ValueError("rotation of an axis outside the geometry")
    turned = _vector(angles.get(axis, 0.0) for axis in GEOMETRY_AXES)
    return NcFrame(matrix=_matrix(turned, (1.0, 1.0, 1.0), (False, False, False)))


def crpl(index: int, angle_deg: float) -> NcFrame:
    """CRPL: rotation in the plane across geometry axis `index` (0 X, 1 Y, 2 Z), degrees."""
    return NcFrame(matrix=rotation(index, angle_deg).m)


def cscale(factors: Mapping[str, float]) -> NcFrame:
    """CSCALE: scale factors by axis."""
    return _build(factors, "SC")


def cmirror(axes: Iterable[str]) -> NcFrame:
    """CMIRROR: mirrored axes."""
    return _build(dict.fromkeys(axes, 1.0), "MI")


def _build(values: Mapping[str, float], component: str) -> NcFrame:
    frame = NEUTRAL
    for axis, value in values.items():
        frame = frame.with_component(axis, component, value)
    return frame


def _matrix(angles: Vector, scales: Vector, mirrored: tuple[bool, bool, bool]) -> Matrix:
    factors = [-s if flag else s for s, flag in zip(scales, mirrored, strict=True)]
    turned = rotation(2, angles[2]) @ rotation(1, angles[1]) @ rotation(0, angles[0])
    return (turned @ scaling(*factors)).m


def _axis_part(part: AxisFrame | None, name: str, value: float) -> AxisFrame:
    part = part or AxisFrame()
    match name:
        case "TR":
            return replace(part, coarse=value)
        case "FI":
            return replace(part, fine=value)
        case "SC":
            return replace(part, scale=value)
        case _:
            return replace(part, mirrored=bool(value))


def _norm(values: Iterable[float]) -> float:
    return hypot(*values)


def _add(a: Vector, b: Vector) -> Vector:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def _set(values: Vector, index: int, value: float) -> Vector:
    return _vector(value if i == index else v for i, v in enumerate(values))


def _vector(values: Iterable[float]) -> Vector:
    x, y, z = values
    return (x, y, z)

"""Affine maps of the three geometry axes.

A frame maps a point of an inner system to the outer one: p' = M·p + t. Frames compose with `@`: `(f @ g)(p) = f(g(p))`,
which is how FANUC chains rotation and shift and how SINUMERIK's `:` operator chains frames.
"""

from __future__ import annotations

from math import cos, radians, sin

from polycnc.deferred.records import dataclass

Vector = tuple[float, float, float]
Matrix = tuple[Vector, Vector, Vector]
_UNIT: Matrix = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True, slots=True)
class Frame:
    """An affine map with matrix `m` (rows) and translation `t` in millimetres."""

    m: Matrix = _UNIT
    t: Vector = (0.0, 0.0, 0.0)

    @property
    def is_identity(self) -> bool:
        """Whether the frame changes nothing."""
        return self.t == (0.0, 0.0, 0.0) and self.m == _UNIT

    @property
    def mirrors(self) -> bool:
        """Whether left and right change places (negative determinant)."""
        (a, b, c), (d, e, f), (g, h, i) = self.m
        return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g) < 0.0

    def apply(self, x: float, y: float, z: float) -> Vector:
        """The image of a point."""
        r0, r1, r2 = self.m
        return (
            r0[0] * x + r0[1] * y + r0[2] * z + self.t[0],
            r1[0] * x + r1[1] * y + r1[2] * z + self.t[1],
            r2[0] * x + r2[1] * y + r2[2] * z + self.t[2],
        )

    def direct(self, x: float, y: float, z: float) -> Vector:
        """The image of a direction: no translation."""
        r0, r1, r2 = self.m
        return (
            r0[0] * x + r0[1] * y + r0[2] * z,
            r1[0] * x + r1[1] * y + r1[2] * z,
            r2[0] * x + r2[1] * y + r2[2] * z,
        )

    def __matmul__(self, inner: Frame) -> Frame:
        if self.is_identity and inner.is_identity:
            return IDENTITY
        columns = list(zip(*inner.m, strict=True))
        rows = [tuple(sum(r[k] * c[k] for k in range(3)) for c in columns) for r in self.m]
        m: Matrix = (_v(rows[0]), _v(rows[1]), _v(rows[2]))
        return Frame(m, self.apply(*inner.t))

    def inverse(self) -> Frame:
        """The map back; raises `ZeroDivisionError` where a scale is zero."""
        (a, b, c), (d, e, f), (g, h, i) = self.m
        det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
        m: Matrix = (
            ((e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det),
            ((f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det),
            ((d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det),
        )
        x, y, z = Frame(m).apply(*self.t)
        return Frame(m, (-x, -y, -z))


def _v(values: tuple[float, ...]) -> Vector:
    return (values[0], values[1], values[2])


IDENTITY = Frame()


def translation(x: float, y: float, z: float) -> Frame:
    """A shift, mm."""
    return Frame(_UNIT, (x, y, z))


def scaling(x: float, y: float, z: float) -> Frame:
    """Factors along the axes; a factor of -1 mirrors."""
    return Frame(((x, 0.0, 0.0), (0.0, y, 0.0), (0.0, 0.0, z)))


def rotation(axis: int, angle_deg: float) -> Frame:
    """Right-handed rotation about geometry axis 0, 1 or 2; multiples of 90 degrees are exact."""
    c, s = cos_sin_deg(angle_deg)
    rows = [[1.0 if i == j else 0.0 for j in range(3)] for i in range(3)]
    j, k = (axis + 1) % 3, (axis + 2) % 3
    rows[j][j] = rows[k][k] = c
    rows[j][k], rows[k][j] = -s, s
    return Frame((_v(tuple(rows[0])), _v(tuple(rows[1])), _v(tuple(rows[2]))))


def about(center: Vector, frame: Frame) -> Frame:
    """A linear map about a fixed point instead of the origin."""
    return translation(*center) @ frame @ translation(-center[0], -center[1], -center[2])


def cos_sin_deg(angle_deg: float) -> tuple[float, float]:
    """Cosine and sine of an angle in degrees, exact at multiples of 90."""
    if angle_deg % 90.0 == 0.0:
        return QUARTERS[int(angle_deg % 360.0 / 90.0)]
    angle = radians(angle_deg % 360.0)
    return cos(angle), sin(angle)


#: Cosine and sine of 0, 90, 180 and 270 degrees.
QUARTERS = ((1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0))

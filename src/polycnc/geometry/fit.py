"""Best fit of points to points: the rigid motion with the smallest sum of squared distances.

Source: B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", J. Opt. Soc. Am. A 4
(1987): the rotation is the eigenvector of the largest eigenvalue of a symmetric 4 x 4 matrix.
"""

from __future__ import annotations

from math import hypot, sqrt

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import Frame, Vector
from polycnc.geometry.vectors import minus

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Sine of the angle between two sides of a triangle below which its corners count as lying on one line.
COLLINEAR_SINE = 1e-6
_SWEEPS = 60


def is_collinear(a: Vector, b: Vector, c: Vector) -> bool:
    """Whether three points lie on one line, or two of them coincide."""
    p, q = minus(b, a), minus(c, a)
    n = (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])
    return hypot(*n) <= COLLINEAR_SINE * hypot(*p) * hypot(*q)


def rigid_fit(ideal: Sequence[Vector], measured: Sequence[Vector]) -> Frame:
    """The rotation and shift that bring the ideal points nearest to the measured ones, in the same order."""
    a, b = _mean(ideal), _mean(measured)
    s = [[0.0] * 3 for _ in range(3)]
    for p, q in zip(ideal, measured, strict=True):
        u, v = minus(p, a), minus(q, b)
        for i in range(3):
            for j in range(3):
                s[i][j] += u[i] * v[j]
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = s
    w, x, y, z = _dominant_vector(
        [
            [xx + yy + zz, yz - zy, zx - xz, xy - yx],
            [yz - zy, xx - yy - zz, xy + yx, zx + xz],
            [zx - xz, xy + yx, yy - xx - zz, yz + zy],
            [xy - yx, zx + xz, yz + zy, zz - xx - yy],
        ]
    )
    turned = Frame(
        (
            (w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z),
        )
    )
    return Frame(turned.m, minus(b, turned.apply(*a)))


def distances(frame: Frame, ideal: Sequence[Vector], measured: Sequence[Vector]) -> list[float]:
    """How far each ideal point is from its measured one after the motion, mm."""
    return [hypot(*minus(frame.apply(*p), q)) for p, q in zip(ideal, measured, strict=True)]


def _dominant_vector(matrix: list[list[float]]) -> list[float]:
    """Unit eigenvector of the largest eigenvalue of a symmetric matrix, by Jacobi rotations."""
    n = len(matrix)
    a = [row[:] for row in matrix]
    vectors = [[float(i == j) for j in range(n)] for i in range(n)]
    for _ in range(_SWEEPS):
        p, q = max(((i, j) for i in range(n) for j in range(i)), key=lambda ij: abs(a[ij[0]][ij[1]]))
        if abs(a[p][q]) <= 1e-15 * max(abs(a[i][i]) for i in range(n)):
            break
        theta = 0.5 * (a[q][q] - a[p][p]) / a[p][q]
        t = (1.0 if theta >= 0.0 else -1.0) / (abs(theta) + sqrt(theta * theta + 1.0))
        c = 1.0 / sqrt(t * t + 1.0)
        s = t * c
        for k in range(n):
            a[k][p], a[k][q] = c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]
        for k in range(n):
            a[p][k], a[q][k] = c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]
            vectors[k][p], vectors[k][q] = (
                c * vectors[k][p] - s * vectors[k][q],
                s * vectors[k][p] + c * vectors[k][q],
            )
    best = max(range(n), key=lambda i: a[i][i])
    return [vectors[k][best] for k in range(n)]


def _mean(points: Sequence[Vector]) -> Vector:
    x, y, z = (sum(values) / len(points) for values in zip(*points, strict=True))
    return (x, y, z)

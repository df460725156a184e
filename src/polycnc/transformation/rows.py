"""Transformations of tables: arrays (n, axes) of points of the path or of positions of the axes. Needs NumPy."""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np
    import numpy.typing as npt

    from polycnc.geometry.frames import Frame
    from polycnc.transformation.contract import Geometry, Transformation

    Table = npt.NDArray[np.float64]


def machine_rows(transformation: Transformation, work: Table) -> Table:
    """Positions of the axes (n, axes) at points of the path (n, axes); row by row the bits of `to_machine`."""
    import numpy as np

    return np.stack(transformation.to_machine(list(work.T)), axis=1)


def work_rows(transformation: Transformation, axes: Table) -> Table:
    """Points of the path (n, axes) for positions of the axes (n, axes); row by row the bits of `to_work`."""
    import numpy as np

    return np.stack(transformation.to_work(list(axes.T)), axis=1)


def jacobian_rows(transformation: Transformation, work: Table) -> Table:
    """Derivatives (n, axes, axes) of the axes by the numbers of the points (n, axes)."""
    import numpy as np

    count, width = work.shape
    slopes = np.empty((count, width, width))
    for i, row in enumerate(transformation.jacobian(list(work.T))):
        for j, slope in enumerate(row):
            slopes[:, i, j] = slope
    return slopes


def mapped_rows(frame: Frame, table: Table, geometry: Geometry) -> Table:
    """A table (n, axes) with the geometry axes mapped by a frame; an axis that does not exist counts as zero."""
    mapped = table.copy()
    x, y, z = (table[:, i] if i >= 0 else 0.0 for i in geometry)
    for i, (a, b, c), shift in zip(geometry, frame.m, frame.t, strict=True):
        if i >= 0:
            mapped[:, i] = a * x + b * y + c * z + shift
    return mapped

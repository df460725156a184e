"""Between work coordinates, the coordinates in which the path is laid out, and the real axes.

The path is laid out in machine coordinates of the axes that the program sees. Without a transformation these are
the real axes; under one (polar interpolation, tool centre point) they are those that the control makes of them.
"""

from __future__ import annotations

from array import array

from polycnc.deferred.records import replace
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.motion.kernels.columns import MOST_OFF, MOST_SWUNG, SWUNG
from polycnc.toolpath.kinds import CURVE_WIDTH, Kind
from polycnc.transformation.rows import machine_rows, mapped_rows

if TYPE_CHECKING:
    from collections.abc import Sequence

    from polycnc.toolpath import Context
    from polycnc.toolpath.table import Chunk
    from polycnc.transformation.contract import Geometry
    from polycnc.transformation.rows import Table


def work_of(machine: Sequence[float], context: Context, geometry: Geometry) -> list[float]:
    """Work coordinates (absolute display, internal units) at machine coordinates."""
    offsets = context.offsets or (0.0,) * len(machine)
    position = [value - offset for value, offset in zip(machine, offsets, strict=True)]
    if not context.frame.is_identity:
        inner = context.frame.inverse().apply(*(position[i] if i >= 0 else 0.0 for i in geometry))
        for i, value in zip(geometry, inner, strict=True):
            if i >= 0:
                position[i] = value
    return position


def machine_of(work: Sequence[float], context: Context, geometry: Geometry) -> list[float]:
    """Machine coordinates at work coordinates."""
    position = list(work)
    if not context.frame.is_identity:
        image = context.frame.apply(*(work[i] if i >= 0 else 0.0 for i in geometry))
        for i, value in zip(geometry, image, strict=True):
            if i >= 0:
                position[i] = value
    offsets = context.offsets or (0.0,) * len(position)
    return [value + offset for value, offset in zip(position, offsets, strict=True)]


def real_of(on_path: Sequence[float], context: Context, geometry: Geometry) -> list[float]:
    """The real axes at a position of the path."""
    if context.transformation is None:
        return list(on_path)
    return machine_of(
        context.transformation.to_machine(work_of(on_path, context, geometry)), context, geometry
    )


def real_rows(on_path: Table, context: Context, geometry: Geometry) -> Table:
    """`real_of` for a table (n, axes) of positions."""
    if context.transformation is None:
        return on_path
    offsets = context.offsets or (0.0,) * on_path.shape[1]
    work = on_path - offsets
    if context.frame.is_identity:
        return machine_rows(context.transformation, work) + offsets
    work = mapped_rows(context.frame.inverse(), work, geometry)
    return mapped_rows(context.frame, machine_rows(context.transformation, work), geometry) + offsets


def path_of(real: Sequence[float], context: Context, geometry: Geometry) -> list[float]:
    """The position of the path at which the real axes are."""
    if context.transformation is None:
        return list(real)
    return machine_of(context.transformation.to_work(work_of(real, context, geometry)), context, geometry)


def with_axis(
    on_path: Sequence[float], context: Context, geometry: Geometry, column: int, place: float
) -> list[float]:
    """The position of the path at which one of the real axes stands elsewhere."""
    real = real_of(on_path, context, geometry)
    real[column] = place
    return path_of(real, context, geometry)


def carried(on_path: Sequence[float], last: Context, context: Context, geometry: Geometry) -> list[float]:
    """A position of the path under another context, the real axes being the same."""
    if context.transformation is last.transformation:
        return list(on_path)
    return path_of(real_of(on_path, last, geometry), context, geometry)


def without_transformation(context: Context) -> Context:
    """The context for displays of real axes."""
    return context if context.transformation is None else replace(context, transformation=None)


def shown_by_hand(context: Context) -> Context:
    """The context for displays of axes that an operator moves one by one.

    The tip that they lead is shown where it is. A transformation with a pole has two places for a position of the axes.
    """
    transformation = context.transformation
    return (
        context if transformation is None or transformation.pole is None else without_transformation(context)
    )


def led_to(
    chunk: Chunk, row: int, context: Context, geometry: Geometry, turning: Sequence[int]
) -> list[float]:
    """Where a row leads, work coordinates: its end, or beside it where its curve parameters say so.

    It is what `lead_beside` of the kernels does in machine coordinates. `turning` are the columns of rotary axes.
    """
    n, at = chunk.axes, CURVE_WIDTH * chunk.curve[row]
    end = list(chunk.end[row * n : (row + 1) * n])
    if chunk.kind[row] != Kind.FEED or at < 0:
        return end
    shift = tuple(chunk.curves[at : at + MOST_OFF])
    if not context.frame.is_identity:
        shift = context.frame.inverse().direct(*shift)
    own = geometry if context.transformation is None else context.transformation.geometry
    swung = chunk.curves[at + SWUNG : at + MOST_SWUNG]
    for column, by in (*zip(own, shift, strict=True), *zip(turning, swung, strict=False)):
        if column >= 0:
            end[column] += by
    return end


def led_ends(
    chunk: Chunk, rows: tuple[int, int], context: Context, geometry: Geometry, turning: Sequence[int]
) -> array[float]:
    """The ends of a chunk, of rows from one to before another of one context where they lead."""
    n, ends = chunk.axes, chunk.end
    for row in range(*rows):
        if chunk.curve[row] >= 0 and chunk.kind[row] == Kind.FEED:
            ends = ends[:] if ends is chunk.end else ends
            ends[row * n : (row + 1) * n] = array("d", led_to(chunk, row, context, geometry, turning))
    return ends

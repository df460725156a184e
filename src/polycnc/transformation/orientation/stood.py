"""What the kernel `standing` must know of a tool centre point, as its flat record."""

from __future__ import annotations

from array import array
from math import inf
from typing import TYPE_CHECKING

from polycnc.geometry.frames import IDENTITY
from polycnc.machine.kinematics import unit
from polycnc.transformation.orientation.records import StandRecord

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from polycnc.geometry.frames import Frame
    from polycnc.transformation.orientation.tool_centre import ToolCentrePoint


def _anywhere(_axis: str) -> tuple[float, float]:
    return -inf, inf


def stand_record(
    point: ToolCentrePoint | None,
    *,
    frame: Frame = IDENTITY,
    shifts: Sequence[float] = (),
    travel: Callable[[str], tuple[float, float]] = _anywhere,
    cone_deg: float = 0.0,
    evenly: bool = True,
) -> array[float]:
    """The record; without two rotary joints the kernel decides nothing by it.

    Args:
        point: The tool centre point that leads the axes; None for none.
        frame: How programmed directions are turned.
        shifts: What is added to positions of the path in front of it, a number for each axis or none.
        travel: Lowest and highest position of a rotary axis by its name, counted as `point.zero` counts.
        cone_deg: Half the opening of the cones about poles.
        evenly: The axes go evenly, however far they turn.
    """
    record = array("d", bytes(8 * StandRecord.SIZE))
    record[StandRecord.OUTER] = -1.0
    turns = point.kinematics.turns if point is not None else ()
    if point is None or len(turns) != 2:
        return record
    for k, (joint, sense) in enumerate(turns):
        column = point.axes.index(joint.axis)
        zero, (low, high) = point.zero[column], travel(joint.axis)
        record[StandRecord.OUTER + k], record[StandRecord.SENSE + k] = column, sense
        _put(record, (StandRecord.OUTER_DIRECTION, StandRecord.INNER_DIRECTION)[k], unit(joint.direction))
        record[StandRecord.ADDED + k] = zero + (shifts[column] if shifts else 0.0)
        record[StandRecord.LOW + k], record[StandRecord.HIGH + k] = low + zero, high + zero
    _put(record, StandRecord.ALONG, unit(point.kinematics.along))
    _put(record, StandRecord.FRAME, (*frame.m[0], *frame.m[1], *frame.m[2]))
    record[StandRecord.CONE], record[StandRecord.EVENLY] = cone_deg, evenly
    return record


def _put(record: array[float], at: int, numbers: Sequence[float]) -> None:
    record[at : at + len(numbers)] = array("d", numbers)

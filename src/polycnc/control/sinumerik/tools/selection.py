"""What holds when an edge is selected: setting data, functions and frames on which its lengths depend (7.3)."""

from __future__ import annotations

from math import hypot

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.tools.lengths import Rules
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.frames import Frame

if TYPE_CHECKING:
    from polycnc.control.sinumerik.family import SinumerikChannel


@dataclass(slots=True)
class LengthSign(State, lifetime=Lifetime.RESET):
    """How ISO code chooses lengths.

    Attributes:
        against: G44: those of edges that are selected from here on count against the tool.
    """

    against: bool = False


def rules_of(channel: SinumerikChannel) -> Rules:
    """The rules that hold now."""
    data, total = channel.memory.data, channel.memory.frames.total()
    temperature = (0.0, 0.0, 0.0)
    if data.integer("$MC_TOOL_TEMP_COMP_ON"):
        x, y, z = (data.number("$SC_TOOL_TEMP_COMP", i) for i in range(3))
        temperature = (x, y, z)
    return Rules(
        channel.mode["plane"],
        data.integer("$SC_TOOL_LENGTH_CONST"),
        data.integer("$SC_TOOL_LENGTH_TYPE"),
        bool(data.integer("$SC_MIRROR_TOOL_LENGTH")),
        bool(data.integer("$SC_MIRROR_TOOL_WEAR")),
        bool(data.integer("$SC_WEAR_SIGN_CUTPOS")),
        bool(data.integer("$SC_WEAR_SIGN")),
        data.integer("$SC_WEAR_TRANSFORM"),
        temperature,
        channel.mode["wear_system"],
        total.mirrored,
        unscaled(total.frame),
        channel.mode["language"] == "G291" and LengthSign.of(channel).against,
    )


def unscaled(frame: Frame) -> Frame:
    """Rotation and mirror of a frame: its axes with length 1."""
    columns = [tuple(value / hypot(*column) for value in column) for column in zip(*frame.m, strict=True)]
    rows = list(zip(*columns, strict=True))
    return Frame((rows[0], rows[1], rows[2]))


def follow(channel: SinumerikChannel) -> None:
    """The lengths of the active edge are worked out for the plane that holds."""
    tools = channel.memory.tools
    if tools.rules is None:
        tools.rules = rules_of(channel)
    tools.assign_lengths(channel.mode["plane"])

"""How normal direction control G41.1, G42.1 begins (manual 2.83): a rotary axis keeps a knife at an angle to the path.

The shape vector points along +X while the axis, about Z or Y, stands at machine zero, and along +Y for an axis about X.
The control plane is the one across the axis.
"""

from __future__ import annotations

from math import inf

from polycnc.control.syntec.coordinates.turns import TurnState
from polycnc.control.word_address.states import PolarState
from polycnc.control.word_address.transformations.normal_line import GROUP, LEFT, NormalLineRules, end
from polycnc.control.word_address.transformations.normal_stage import Direction, NormalStage
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.geometry.planes import PLANES
from polycnc.geometry.units import INCH_MM

if TYPE_CHECKING:
    from polycnc.control.syntec.family import SyntecChannel
    from polycnc.control.word_address.block.words import Words

#: Types of axes (Pr221 on) that may follow the cuts.
ROTARY_TYPES = (2, 5)
#: Ranges of E and R in the program's unit.
SHORTEST_RANGE, LONGEST_RANGE = (0.001, 10.0), (0.001, 999_999.0)
#: Control plane of an axis along X, Y or Z, and the angle of the shape vector from its first axis at machine zero.
CONTROL_PLANES = {0: ("G19", 0.0), 1: ("G18", 90.0), 2: ("G17", 0.0)}
_FORBIDDEN: dict[str | tuple[str, str], str] = {
    **dict.fromkeys(("G41", "G42", "G43.4", "G43.5"), "normal_compensation"),
    **dict.fromkeys(("G41.2", "G42.2", "G41.6", "G42.6"), "normal_spatial"),
    **dict.fromkeys(("G53", "G28", "G29", "G30"), "normal_machine"),
    **dict.fromkeys(("G2.4", "G3.4"), "normal_three_point"),
    **dict.fromkeys(("G31", "G31.10", "G31.11", "G37", "G37.2", "G37.3"), "normal_skip"),
    **dict.fromkeys(("G33", "G34"), "normal_thread"),
    **dict.fromkeys(("G81.1", "G81.2"), "normal_oscillation"),
    **dict.fromkeys(("G12.1", "G68.2", "G68.3", "G92.1"), "normal_frame"),
    ("G5", "P"): "normal_smoothing",
}


def rules() -> NormalLineRules:
    """What the control refuses while the axis follows the cuts."""
    return NormalLineRules(_FORBIDDEN, preset="", axis_word="normal_rotary_word", with_its_end=False)


def start(channel: SyntecChannel, words: Words) -> None:
    """G41.1, G42.1 [Q] [P] [E] [R]: from here on the axis follows the cuts."""
    memory, mode = channel.memory, channel.mode
    code = mode[GROUP]
    if not memory.parameters.option_normal_direction or channel.number != 1:
        raise words.fail("option", code)
    if mode["compensation"] != "G40" or mode["length"] in ("G43.4", "G43.5"):
        raise words.fail("normal_compensation", code)
    if PolarState.of(channel).plane is not None or not TurnState.of(channel).plane.is_identity:
        raise words.fail("normal_frame", code)
    axis, place, sense = _rotary_axis(channel, words, code)
    angle, turns_first, shortest, longest = _words(channel, words)
    plane, reference = CONTROL_PLANES[place]
    if mode["plane"] != plane:
        raise words.fail("normal_plane", code)
    end(channel)
    u, v, _ = PLANES[plane]
    geometry = channel.coordinates.geometry
    turn = -angle if code == LEFT else angle
    direction = Direction(
        axis,
        sense,
        (geometry[u], geometry[v]),
        (u, v),
        sense * (turn - reference) - channel.coordinates.offsets[axis],
        shortest,
        longest,
        turns_first,
    )
    channel.flush()
    channel.path.put(NormalStage(direction, channel.toolpath))


def _rotary_axis(channel: SyntecChannel, words: Words, code: str) -> tuple[int, int, float]:
    """The axis of Pr5801: its column, the geometry axis that it turns about, and its sense."""
    memory = channel.memory
    if -1 in channel.coordinates.geometry:
        raise words.fail("normal_linear_axes", code)
    parameters = memory.parameters
    axis = parameters.normal_axis - 1
    if not 0 <= axis < len(channel.axes):
        raise words.fail("normal_rotary_axis", code)
    kind = parameters.axis_types[axis]
    if kind not in ROTARY_TYPES if kind is not None else not channel.axis_data[axis].rotary:
        raise words.fail("normal_axis_type", code)
    at = (parameters.normal_axis_direction, parameters.normal_axis_place)
    joints = [
        j for j in (*channel.machine.tool_chain, *channel.machine.work_chain) if j.axis == channel.axes[axis]
    ]
    if 0 in at or not joints:
        raise words.fail("normal_not_set", code)
    nose = (parameters.normal_nose_x, parameters.normal_nose_y, parameters.normal_nose_z)
    if joints[0] not in channel.machine.tool_chain or any(nose):
        raise channel.control.not_yet("G41.1 Pr5804", code)
    along = [abs(component) > 1.0 - 1e-9 for component in joints[0].direction]
    if True not in along:
        raise words.fail("normal_not_set", code)
    place = along.index(True)
    return axis, place, 1.0 if joints[0].direction[place] > 0.0 else -1.0


def _words(channel: SyntecChannel, words: Words) -> tuple[float, bool, float, float]:
    """Q in degrees, whether P turns first, and E and R in millimetres."""
    unit = INCH_MM if words.plan.inch else 1.0
    angle, way = words.angle("Q") or 0.0, words.typed("P") or 0
    shortest, longest = words.length("E"), words.length("R")
    for value, (low, high), address in ((shortest, SHORTEST_RANGE, "E"), (longest, LONGEST_RANGE, "R")):
        if value is not None and not low - 1e-9 <= value / unit <= high + 1e-9:
            raise words.fail("normal_words", address)
    if not 0.0 <= angle <= 180.0 or way not in (0, 1):
        raise words.fail("normal_words", "P" if way not in (0, 1) else "Q")
    parameters = channel.memory.parameters
    shortest = max(parameters.normal_shortest, 0.0) if shortest is None else shortest
    if longest is None:
        longest = parameters.normal_longest if parameters.normal_longest > 0.0 else inf
    if shortest >= longest:
        raise words.fail("normal_lengths", channel.mode[GROUP])
    return angle, way == 1, shortest, longest

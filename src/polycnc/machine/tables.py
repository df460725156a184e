"""The keys of a machine file as a type checker sees them, once `schema` has taken them and bases are laid under.

For types only: `schema` holds the same keys with their ranges, and a test holds the two together.
"""

from __future__ import annotations

from typing import Literal, NotRequired, TypeAlias, TypedDict

AxisKind = Literal["linear", "rotary"]
Carries = Literal["tool", "work"]
Timing = Literal["before", "with", "after"]
#: What waits until a spindle has its speed: the block that asks for it, the first cut behind it, or nothing.
SpeedWait = Literal["block", "cut", "never"]
Pockets = Literal["random", "fixed"]
Turns = Literal["shortest", "forward"]
#: What an M function does in the control beside what the machine does.
Act = Literal[
    "spindle_clockwise", "spindle_counter_clockwise", "spindle_stop", "tool_change",
    "feed_override_off", "feed_override_on", "spindle_override_off", "spindle_override_on",
    "mirror_first_axis", "mirror_second_axis", "mirror_off",
]  # fmt: skip
Latch = Literal["", "on", "off", "toggle"]
#: In one language, or a text for each.
TextData: TypeAlias = "str | LanguagesData"
LanguagesData = TypedDict("LanguagesData", {"en": str, "zh-TW": NotRequired[str]})


class DynamicsData(TypedDict, total=False):
    """Speeds and accelerations of an axis, or the defaults of a kind."""

    rapid: float
    max_feed: float
    acceleration: float
    jerk: float
    rapid_time_s: float
    rapid_bell_s: float
    cutting_time_s: float
    cutting_bell_s: float
    after_interpolation_s: float
    in_position_fine: float
    in_position_coarse: float


class DefaultsData(TypedDict, total=False):
    """`[defaults]`."""

    linear: DynamicsData
    rotary: DynamicsData


class AxisData(DynamicsData, total=False):
    """`[axis.NAME]`."""

    kind: AxisKind
    modulo: bool
    diameter: bool
    parallel_to: str
    aliases: list[str]
    machine_name: str
    limit_minus: float
    limit_plus: float
    reference_points: list[float]


class ChannelData(TypedDict, total=False):
    """`[channel.NUMBER]`."""

    axes: list[str]
    names: list[str]
    geometry: dict[str, str]
    virtual: list[str]
    spindles: list[int]


class GearData(TypedDict):
    """One entry of `gears`."""

    min_rpm: float
    max_rpm: float


class SpindleData(TypedDict, total=False):
    """`[spindle.NUMBER]`."""

    name: str
    min_rpm: float
    max_rpm: float
    acceleration: float
    orient_s: float
    carries: Carries
    axis: str
    gears: list[GearData]
    speed_wait: SpeedWait


class MagazineData(TypedDict, total=False):
    """`[magazine]`."""

    kind: Literal["magazine", "turret"]
    places: int
    change_time_s: float
    place_time_s: float
    pockets: Pockets
    turns: Turns
    change_at: dict[str, list[int]] | Literal["anywhere"]
    retracts: bool


class MFunctionData(TypedDict, total=False):
    """`[m_function.CODE]`."""

    name: TextData
    seconds: float
    timing: Timing
    takes: list[str]
    calls: str
    does: Act


class GFunctionData(TypedDict, total=False):
    """`[g_function.CODE]`."""

    name: TextData
    seconds: float
    takes: list[str]
    calls: str


class JointData(TypedDict):
    """`[[joint]]`."""

    axis: str
    carries: Carries
    direction: list[float]
    offset: NotRequired[list[float]]


class SolidData(TypedDict):
    """`[[solid]]`."""

    name: TextData
    role: Literal["table", "chuck", "tailstock", "fixture", "head", "guard"]
    shape: Literal["box", "cylinder"]
    position: list[float]
    size: list[float]
    direction: NotRequired[list[float]]
    moves_with: str


class RuleData(TypedDict):
    """`[[rule]]`."""

    when: str
    output: str
    after_s: NotRequired[float]
    latch: NotRequired[Latch]


class AlarmData(TypedDict):
    """`[[alarm]]` and `[[message]]`."""

    code: str
    when: str
    text: NotRequired[TextData]
    cause: NotRequired[TextData]
    remedy: NotRequired[TextData]


class BuilderData(TypedDict, total=False):
    """A file that `rules` names."""

    magazine: MagazineData
    m_function: dict[str, MFunctionData]
    g_function: dict[str, GFunctionData]
    rule: list[RuleData]
    alarm: list[AlarmData]
    message: list[AlarmData]


class MachineData(BuilderData, total=False):
    """A whole file."""

    base: str
    rules: str
    name: TextData
    description: TextData
    interpolation_cycle_s: float
    settle_fine_s: float
    settle_coarse_s: float
    block_time_s: float
    tool_direction: list[float]
    nose: list[float]
    control_variant: str
    control_options: list[str]
    defaults: DefaultsData
    channel: dict[str, ChannelData]
    axis: dict[str, AxisData]
    spindle: dict[str, SpindleData]
    joint: list[JointData]
    solid: list[SolidData]

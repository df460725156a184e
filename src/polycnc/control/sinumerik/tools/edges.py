"""One cutting edge and its parameters, `$TC_DP1` to `$TC_DP25`.

Source: job planning 7.1 (tool parameters), 7.2 (additive offsets).
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field, replace
from polycnc.memory.encoding import encoded

#: Parameters of a cutting edge: $TC_DP1 … $TC_DP25.
PARAMETERS = 25
DP_TYPE, DP_TIP, DP_LENGTH, DP_RADIUS = 1, 2, 3, 6
DP_CORNER_RADIUS, DP_HOLDER_ANGLE, DP_SIDE_ANGLE, DP_CLEARANCE = 7, 10, 11, 24
#: Of contour tools the angle limits stand there.
DP_LEAST_ANGLE, DP_LARGEST_ANGLE = DP_HOLDER_ANGLE, DP_SIDE_ANGLE
#: The cutting direction of a turning tool stands where mills have their angle.
DP_DIRECTION = DP_SIDE_ANGLE
DP_WEAR_LENGTH, DP_WEAR_RADIUS, DP_BASE_LENGTH = 12, 15, 21
#: Parameters of the wear: what FTOCON keeps to itself.
WEAR_PARAMETERS = range(DP_WEAR_LENGTH, DP_BASE_LENGTH)
#: From a parameter to its wear: $TC_DP6 has $TC_DP15.
WEAR = DP_WEAR_RADIUS - DP_RADIUS
#: Types from 400 to 599 are turning and grinding tools, those below 500 grinding tools.
TURNING_TYPES = range(400, 600)
GRINDING_TYPES = range(400, 500)
#: Of a slotting saw $TC_DP6 is the diameter.
SAW = 700
#: Names behind `$TC_DP` of the direction of the tool: as a number, and along lengths 1 to 3; and of the edge's normal.
DIRECTION, DIRECTION_PARTS = "V", ("V3", "V4", "V5")
NORMAL_PARTS = ("VN3", "VN4", "VN5")
#: Additive offsets: wear (fine), set-up (coarse).
FINE, COARSE = "SCP", "ECP"


@encoded("cutting edge")
@dataclass(slots=True)
class Edge:
    """One cutting edge.

    Attributes:
        values: `values[n]` is `$TC_DPn`.
        teeth: Number of teeth, `$TC_DPNT`.
        cutting_edge: `$TC_DPCE`, 0 while it equals the D number.
        is_valid: False after DZERO.
        additive: Additive offsets, wear (`$TC_SCPn`) and setup (`$TC_ECPn`), by kind and number n.
        directions: Direction of the tool and normal of the edge, `$TC_DPV…` by what is behind `$TC_DP` in their names;
            what is not there is 0.
    """

    values: list[float] = field(default_factory=lambda: [0.0] * (PARAMETERS + 1))
    teeth: float = 0.0
    cutting_edge: int = 0
    is_valid: bool = True
    additive: dict[tuple[str, int], float] = field(default_factory=dict)
    directions: dict[str, float] = field(default_factory=dict)

    @property
    def type(self) -> int:
        """Type of the tool, `$TC_DP1`."""
        return int(self.values[DP_TYPE])

    @property
    def is_turning(self) -> bool:
        """Whether lengths and radius are those of a turning or grinding tool."""
        return self.type in TURNING_TYPES

    @property
    def has_angle_limits(self) -> bool:
        """Whether it cuts between two angles only, as an edge of a contour tool (7.1)."""
        return self.is_turning and any(self.total(n) for n in (DP_LEAST_ANGLE, DP_LARGEST_ANGLE))

    @property
    def without_base(self) -> Edge:
        """The same without base dimensions."""
        values = [
            value if n < DP_BASE_LENGTH or n > DP_BASE_LENGTH + 2 else 0.0
            for n, value in enumerate(self.values)
        ]
        return replace(self, values=values)

    @property
    def has_normal(self) -> bool:
        """Whether it has a normal of its own ($TC_DPVN3 to 5)."""
        return any(self.directions.get(name) for name in NORMAL_PARTS)

    @property
    def is_grinding(self) -> bool:
        """Whether it is a grinding wheel."""
        return self.type in GRINDING_TYPES

    def added(self, kind: str, location: int, parameter: int) -> float:
        """What DL adds to a parameter: location x, parameter y have the number 10x + y in their names."""
        return self.additive.get((kind, 10 * location + parameter), 0.0) if location else 0.0

    def wear(self, parameter: int, location: int = 0) -> float:
        """Wear of a parameter from 3 to 11 with the additive offsets of a location (DL)."""
        fine, coarse = (self.added(kind, location, parameter) for kind in (FINE, COARSE))
        return self.values[parameter + WEAR] + fine + coarse

    def total(self, parameter: int, location: int = 0, *, inverts: bool = False) -> float:
        """A parameter from 6 to 11 with its wear; `inverts`: wear counts the other way (SD42930)."""
        wear = self.wear(parameter, location)
        return self.values[parameter] + (-wear if inverts else wear)

    def radius(self, location: int = 0, *, inverts: bool = False) -> float:
        """Radius with wear, mm."""
        size = self.total(DP_RADIUS, location, inverts=inverts)
        return 0.5 * size if self.type == SAW else size

    def length(self, i: int, location: int = 0) -> float:
        """Length 1, 2 or 3 (`i` from 0) with wear and base, as they were measured, mm."""
        return (
            self.values[DP_LENGTH + i] + self.values[DP_BASE_LENGTH + i] + self.wear(DP_LENGTH + i, location)
        )

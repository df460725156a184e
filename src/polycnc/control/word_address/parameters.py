"""The parameters that modules of the word-address base read, by the names that they have on every control.

A control's list of parameters gives each its number and its delivered value (`fanuc/parameters.toml`,
`meldas/parameters.toml`), and the module written from it takes the place of what stands here. Where a control has no
such parameter, the constant holds. Names in capitals are FANUC's mnemonics; what they mean stands in FANUC's list.
"""

from __future__ import annotations

from polycnc.control.parameters import AxisParameters, Constant, ControlParameters, Parameter
from polycnc.deferred.typing import TypeVar


class MacroAxisParameters(AxisParameters):
    """The parameters that every axis of a control with custom macro B has."""

    basic_axis: Parameter[int | None] = Constant(None)
    overrun: Parameter[float] = Constant(0.0)
    travel_lower: Parameter[float | None] = Constant(None)
    travel_upper: Parameter[float | None] = Constant(None)
    reference_point_1: Parameter[float | None]
    reference_point_2: Parameter[float | None]
    reference_point_3: Parameter[float | None]
    reference_point_4: Parameter[float | None]

    @property
    def reference_points(self) -> tuple[float | None, ...]:
        """The first to fourth reference point, machine coordinates; None where the machine says it."""
        return (
            self.reference_point_1,
            self.reference_point_2,
            self.reference_point_3,
            self.reference_point_4,
        )


A_co = TypeVar("A_co", bound=MacroAxisParameters, covariant=True)


class MacroParameters(ControlParameters[A_co]):
    """The parameters of a control with custom macro B."""

    # ---- numbers, arcs, zones --------------------------------------------------------------------------------
    IPR: Parameter[bool] = Constant(False)
    ISA: Parameter[bool] = Constant(False)
    ISC: Parameter[bool] = Constant(False)
    DPI: Parameter[bool] = Constant(False)
    SCR: Parameter[bool] = Constant(False)
    OUT: Parameter[bool] = Constant(False)
    arc_tolerance: Parameter[float]

    # ---- transformations -------------------------------------------------------------------------------------
    polar_linear_axis: Parameter[int | None] = Constant(None)
    polar_rotary_axis: Parameter[int | None] = Constant(None)
    normal_axis: Parameter[int | None]
    normal_turn_feed: Parameter[float]
    normal_least_turn: Parameter[float] = Constant(0.0)
    normal_shortest_move: Parameter[float] = Constant(0.0)

    # ---- macros and programs ---------------------------------------------------------------------------------
    EOR: Parameter[bool] = Constant(False)
    SKF: Parameter[bool] = Constant(True)
    G67: Parameter[bool] = Constant(True)
    SBM: Parameter[bool] = Constant(False)
    SBV: Parameter[bool] = Constant(False)
    PRT: Parameter[bool] = Constant(False)
    CCV: Parameter[bool] = Constant(True)
    CLV: Parameter[bool] = Constant(False)
    MIN: Parameter[bool] = Constant(False)
    MSB: Parameter[bool] = Constant(False)
    MUS: Parameter[bool | None] = Constant(None)
    NAT: Parameter[bool] = Constant(False)
    MLG: Parameter[bool] = Constant(False)
    MCA: Parameter[bool] = Constant(False)
    GMP: Parameter[bool] = Constant(False)
    ON8: Parameter[bool] = Constant(False)

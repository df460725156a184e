"""Going back to a block of a case gives the same rest of it: rows, contexts, variables, alarms, waits."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pytest

from polycnc.cases.format import Case, case_id, parse_case
from polycnc.channel.states.snapshot import Snapshot
from polycnc.channel.states.state import plain_states, plain_tables
from polycnc.channel.waits import CLOCK
from polycnc.session import open_session
from tests.channel.states.test_snapshot import rest_of, state_of
from tests.conformance.reading import FILES, cases_in

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from polycnc.channel.group import GroupRun
    from polycnc.session import Session

#: One case in so many; all of them take minutes.
EVERY = 12
CASES = [
    (parse_case(data), case_id(data, number), path)
    for path in FILES
    for number, data in enumerate(cases_in(path), 1)
]
SOME = [(case, name, path) for case, name, path in CASES if not case.operate][::EVERY]
#: States by the names of their classes, each with a case that changes it, such that it is changed between two blocks.
CHANGED_BY = {
    "Holders": "sin-tools-of-two-holders",
    "ChosenSet": "syntec-conditions",
    "OperatorScreen": "sin-seform",
    "ArcState": "syntec-move-full-circle",
    "ArrivalState": "fanuc-0i-tf-s-makes-a-hole-wait",
    "AxisSettings": "sinumerik-scpara",
    "BalanceState": "fanuc-0i-tf-balance-with-m",
    "BeforeBlock": "sin-smooth-approach-without-contour",
    "BitState": "syntec-lang-bits-io",
    "BlockStart": "syn-polar-pair-of-a-diameter-axis",
    "ChosenContour": "sin-cyc-62",
    "IsoState": "sin-iso-drilling",
    "ClampState": "fanuc-0i-tf-clamp-of-both-sets-the-same",
    "Clock": "sin-clock-is-read-only",
    "Clocks": "meldas-m-clock",
    "CodeState": "fanuc-0i-tf-point-in-m",
    "CommonVariables": "meldas-m-8-levels-of-subprograms",
    "Contour": "sin-cut2d-machine-plane",
    "Containers": "sin-container-turns-by-a-slot",
    "ControlSwitches": "fanuc-0i-tf-3004-is-read-back",
    "CurveState": "meldas-m-nurbs-falling-knot",
    "Couplings": "sin-trail-chain",
    "CurveDefinition": "sin-ctab-flag-of-the-definition",
    "CurveTables": "sin-ctab-memories",
    "CycleState": "fanuc-m-manual-boring-halts",
    "CylinderState": "fanuc-m-transform-cylinder-twice",
    "DiameterState": "syntec-polar-diameter",
    "DrawingState": "fanuc-0i-tf-drawing-next-block-incomplete",
    "Environments": "sin-tool-environment-is-noted",
    "FeedState": "syntec-move-inverse-time-missing",
    "FollowingState": "syn-tip-control-limits-what-follows",
    "Frames": "sinumerik-value-proc-second-line",
    "FunctionState": "syntec-lang-stack-empty",
    "Gears": "sin-gear-cascade",
    "InitialisedState": "sin-initial-ini-sets-standard-values",
    "GlobalState": "syntec-getarg-integer",
    "GrindingState": "fanuc-0i-tf-grind-axis-by-its-name",
    "HypotheticalState": "meldas-m-hypothetical-third-axis",
    "Handed": "sinumerik-md10718-hands-on-tool-and-edge",
    "InterruptState": "syntec-interrupt-left-on",
    "InterruptionState": "fanuc-m-interruption-without-nc-statement",
    "Interrupts": "sinumerik-setint-input-9",
    "LanguageMemory": "sinumerik-value-proc-second-line",
    "LastMove": "sin-program-without-end",
    "LastSkip": "fanuc-0i-tf-g31-without-signal",
    "LastTap": "syntec-tap-retract-other-lead",
    "LengthState": "syntec-setting-no-z",
    "LimitState": "fanuc-0i-tf-largest-increment",
    "LoadedTool": "syntec-t",
    "LocalState": "fanuc-m-negative-m-from-an-expression",
    "MachineData": "sinumerik-init-ram",
    "MachineSignals": "meldas-m-4-levels-of-macros",
    "MacroSignals": "fanuc-m-signals",
    "Measuring": "sinumerik-meas-nothing",
    "ModalCallState": "fanuc-m-macro-for-every-block",
    "ModalMacroState": "syntec-getarg",
    "OffsetMemory": "fanuc-0i-tf-g10-rules",
    "OffsetState": "fanuc-0i-tf-rotation-ended-allows-all",
    "OnTable": "fanuc-m-workpiece-error",
    "OpenLine": "sin-contour-angle-without-end",
    "OverrideState": "fanuc-m-override-codes",
    "Overrides": "sin-acc",
    "ParameterTable": "fanuc-0i-tf-parameter-input-foreign-code",
    "PartCounts": "sin-parts-can-be-written",
    "PathFeed": "sin-posp",
    "PathModeState": "meldas-m-high-speed-modes",
    "PlaneAxes": "syntec-plane-g18-names-its-axes",
    "Polar": "sin-polar-without-pole",
    "PolarCoordinateState": "meldas-m-polar-and-rotation",
    "PolarState": "syntec-polar-diameter",
    "PolynomialGroups": "sin-ori-polynomials-of-axes-alone",
    "PostureState": "syntec-tip-frame",
    "ProgrammingFrames": "fanuc-m-mirrored-arc-turns-the-other-way",
    "Preparations": "sinumerik-execute-goes-on-from-before",
    "ProgrammedFeed": "sin-flin-feed-without-motion",
    "Protection": "sinumerik-def-open",
    "Punching": "sin-spp-longest-segment",
    "RadiusState": "fanuc-0i-tf-rotation-ended-allows-all",
    "Ranges": "sinumerik-newconf-limit",
    "Readings": "sinumerik-def-open",
    "Records": "syntec-records-variables-in-names",
    "ReferenceAxis": "sin-g96-reference-axis",
    "ReferenceState": "fanuc-0i-tf-offset-t-beside-g29",
    "Repositioning": "sinumerik-asub-in-subprogram",
    "RetractState": "syntec-f2-fast",
    "Retraction": "sin-lfon",
    "RigidTappingState": "fanuc-m-motion-behind-m29",
    "RotationState": "fanuc-0i-tf-rotation-refuses-g54",
    "ScaleState": "syntec-move-scale",
    "Sections": "sin-sections",
    "SectionState": "syntec-call-file-of-several-groups",
    "SentCodes": "meldas-m-4-levels-of-macros",
    "SingleCycleState": "fanuc-0i-tf-g92-inside-backwards",
    "SkipState": "syntec-skip-groups-order",
    "Smoothing": "sin-cycle832",
    "SmoothingState": "syntec-tolerance-in-tip-control",
    "SpaceState": "syntec-lang-spaces",
    "SpatialState": "syntec-spatial-arc",
    "SpindleCommand": "fanuc-m-sign-in-speed",
    "SpindleState": "syntec-move-surface-speed-axis",
    "Spindles": "sin-auxiliary-functions",
    "Splines": "sin-bspline-weight-pulls",
    "Stored": "sinumerik-markers-keep-the-look-ahead",
    "Tangential": "sin-tang-words-of-the-axis",
    "ThreadDepthState": "fanuc-0i-tf-g76-least-depth",
    "ThreadState": "fanuc-0i-tf-largest-lead",
    "TiltState": "fanuc-m-plane-turned-by-roll-pitch-yaw",
    "TipState": "syntec-tip-smoothing",
    "ToolOffsets": "meldas-m-offsets-by-program",
    "Tools": "sin-workpiece-init-program",
    "TurnState": "syntec-move-preset-axis",
    "TurningFrames": "fanuc-0i-tf-rotation-refuses-g54",
    "VariableTables": "fanuc-0i-tf-tapping-variants-call-with-t-argument",
    "VirtualAxisState": "syntec-virtual-axis",
    "Wheels": "sin-tmon-size",
    "WorkOffsets": "fanuc-0i-tf-g10-without-point-and-inch",
    "WorkpieceErrors": "fanuc-m-workpiece-error",
    "WrittenParameters": "syntec-setpr-of-user-parameters",
    "ZeroState": "fanuc-0i-tf-preset-value",
}


def session_of(case: Case, path: Path) -> Session:
    """A session of a case that runs block by block."""
    session = open_session(
        case.program.removesuffix("\n") + "\n",
        control=case.control,
        setup=case.setup,
        files=case.files,
        folder=path.parent,
        block_limit=20_000,
    )
    session.channel.single_block = session.channel.block_by_block = True
    return session


def check_from_here(run: GroupRun, session: Session) -> None:
    """The rest of the case is the same every time."""
    here, snapshot = state_of(session.group), Snapshot(session.group)
    first = rest_of(run, session.group)
    for _ in range(2):
        snapshot.restore()
        assert state_of(session.group) == here
        assert rest_of(run, session.group) == first


@pytest.mark.parametrize(
    ("case", "path"), [(case, path) for case, _, path in SOME], ids=[name for _, name, _ in SOME]
)
def test_the_rest_of_a_case_is_the_same_from_a_block_on(case: Case, path: Path) -> None:
    session = session_of(case, path)
    run = session.group.run(session.result.program)
    for _ in range(Random(case.id).randint(0, 12)):
        if next(run, None) is None:
            break
    check_from_here(run, session)


def changed_states(session: Session, begun: Mapping[str, object]) -> set[str]:
    """States of any channel that are not as they began, by the names of their classes; tables as against `begun`."""
    found: set[str] = set()
    for channel in session.group.channels:
        if channel.memory is not None:
            found |= plain_states(channel).keys()
            tables = plain_tables(channel).items()
            found |= {name.rpartition(".")[0] for name, table in tables if table and begun.get(name) != table}
    return found


@pytest.mark.parametrize(("state", "case_id"), CHANGED_BY.items(), ids=CHANGED_BY)
def test_a_state_comes_back_where_it_is_changed(state: str, case_id: str) -> None:
    case, _, path = next(each for each in CASES if each[1] == case_id)
    session = session_of(case, path)
    run = session.group.run(session.result.program)
    begun: dict[str, object] = {}
    for number, wait in enumerate(run):
        assert wait is not CLOCK, f"{case_id} needs the clock before it changes {state}"
        if number == 0:
            begun = plain_tables(session.channel)
        if state in changed_states(session, begun):
            break
    else:
        pytest.fail(f"{case_id} changes no {state} that is there between two blocks")
    check_from_here(run, session)

"""Every bound of the planner is known to the account of time, and named where it holds."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import pytest

from polycnc.kernels.layout import Places
from polycnc.messages import text
from polycnc.motion.explain import Cause
from polycnc.motion.explain.causes import BOUNDS
from polycnc.motion.explain.compiled import LIBRARY
from polycnc.motion.explain.kernels.held import Held
from polycnc.motion.kernels.columns import ContextRecord, Limits, PathLimits, Rows
from polycnc.session import open_session
from polycnc.toolpath.context import Pace

if TYPE_CHECKING:
    from collections.abc import Iterable
    from pathlib import Path

    from polycnc.motion.explain import TimeAccount

FANUC, LATHE, MELDAS, SYNTEC, SINUMERIK = (
    "fanuc-m",
    "fanuc-0i-tf",
    "meldas-m",
    "syntec-mill",
    "sinumerik-840d",
)
ZIGZAG = tuple(f"G1 X{0.5 * k:.3f} Y{0.05 * (k % 2):.3f} F6000." for k in range(1, 60))
TURN = ("G1 X50. F6000.", "Y50.")
FAST = ("G1 X200. F90000.",)
FIVE = "mill5-ac-table"
SLOW_BLOCKS = "block_time_s = 0.008\n"
FACETS = tuple(f"G1 X{0.05 * k:.3f} F6000." for k in range(1, 200))


class Case(NamedTuple):
    """A program in which one bound holds for a part of the time, %; at least so many, of one axis."""

    control: str
    lines: tuple[str, ...]
    cause: Cause
    least: float
    axis: str = ""
    parameters: dict[str, object] = {}  # noqa: RUF012 - of a named tuple
    machine: str = "mill3"
    keys: str = ""


def look_ahead(*lines: str) -> tuple[str, ...]:
    return ("G64", "G05.1 Q1", *lines, "G05.1 Q0")


CASES = {
    "F, fanuc": Case(FANUC, ("G1 X200. F600.",), Cause.FEED, 95.0),
    "F, fanuc lathe": Case(LATHE, ("G98 G1 Z-50. F600.",), Cause.FEED, 95.0, machine="lathe2"),
    "F, meldas": Case(MELDAS, ("G1 X200. F600.",), Cause.FEED, 95.0),
    "F, syntec": Case(SYNTEC, ("G1 X200. F600.",), Cause.FEED, 95.0),
    "F, sinumerik": Case(SINUMERIK, ("G1 X200 F600",), Cause.FEED, 95.0),
    "F, inverse time": Case(FANUC, ("G93 G1 X200. F1.",), Cause.FEED, 95.0),
    "G95": Case(SINUMERIK, ("S1000 M3", "G95 G1 X100 F0.5"), Cause.FEED, 95.0),
    "thread": Case(LATHE, ("G97 S300 M3", "G32 Z-50. F2."), Cause.FEED, 60.0, machine="lathe2"),
    "G96": Case(SINUMERIK, ("G96 S100 M3", "G0 X40", "G1 X10 F0.2"), Cause.FEED, 90.0, machine="lathe2"),
    "G96, over the centre": Case(
        SINUMERIK,
        ("G96 S100 M3 LIMS=2000", "G0 X10", "G1 X-10 F0.2"),
        Cause.FEED,
        90.0,
        machine="lathe2",
    ),
    "G96, SOFT": Case(
        SINUMERIK,
        ("SOFT G96 S100 M3", "G0 X40", "G64 G1 X10 F0.2", "Z-5"),
        Cause.FEED,
        80.0,
        machine="lathe2",
    ),
    "1422": Case(FANUC, ("G1 X200. F6000.",), Cause.PATH_FEED, 95.0, "", {"1422": 1000}),
    "1422, arc": Case(FANUC, ("G2 X100. R50. F6000.",), Cause.PATH_FEED, 95.0, "", {"1422": 1000}),
    "Pr405": Case(SYNTEC, ("G1 X200. F6000.",), Cause.PATH_FEED, 95.0, "", {"405": 1000}),
    "1430": Case(FANUC, ("G1 X200. F6000.",), Cause.AXIS_FEED, 95.0, "X", {"1430[X]": 1000}),
    "Pr621": Case(SYNTEC, ("G1 X200. F6000.",), Cause.AXIS_FEED, 95.0, "X", {"621": 1000}),
    "#2002": Case(MELDAS, ("G1 X200. F6000.",), Cause.AXIS_FEED, 95.0, "X", {"2002[X]": 1000}),
    "velocity, fanuc": Case(FANUC, FAST, Cause.AXES, 60.0, "X"),
    "velocity, meldas": Case(MELDAS, FAST, Cause.AXES, 60.0, "X"),
    "velocity, syntec": Case(SYNTEC, FAST, Cause.AXES, 60.0, "X"),
    "velocity, sinumerik": Case(SINUMERIK, FAST, Cause.AXES, 60.0, "X"),
    "velocity, SOFT": Case(SINUMERIK, ("SOFT G64", *FAST, "X400. Y1."), Cause.AXES, 60.0, "X"),
    "velocity behind a tip": Case(
        SYNTEC, ("G43.4 H1", "G1 C180. F90000."), Cause.AXES, 30.0, "C", machine=FIVE
    ),
    "VELOLIM": Case(SINUMERIK, ("VELOLIM[X]=10", *FAST), Cause.PROGRAM_AXIS, 95.0, "X"),
    "VELOLIM, SOFT": Case(
        SINUMERIK, ("SOFT G64 VELOLIM[X]=10", *FAST, "X400. Y1."), Cause.PROGRAM_AXIS, 90.0, "X"
    ),
    "FL": Case(SINUMERIK, ("FGROUP(X)", "FL[Y]=600", "G1 X50 Y50 F6000"), Cause.PROGRAM_AXIS, 95.0, "Y"),
    "Pr3091": Case(
        SYNTEC, ("G43.4 H1", "G1 A40. X50. F5000."), Cause.FOLLOWING, 50.0, "", {"3091": 100}, FIVE
    ),
    "blocks, fanuc": Case(FANUC, FACETS, Cause.BLOCK_TIME, 95.0, keys=SLOW_BLOCKS),
    "blocks, lathe": Case(
        LATHE, ("G98", *FACETS), Cause.BLOCK_TIME, 95.0, machine="lathe2", keys=SLOW_BLOCKS
    ),
    "blocks, meldas": Case(MELDAS, FACETS, Cause.BLOCK_TIME, 95.0, keys=SLOW_BLOCKS),
    "blocks, syntec": Case(SYNTEC, FACETS, Cause.BLOCK_TIME, 90.0, keys=SLOW_BLOCKS),
    "blocks, sinumerik": Case(SINUMERIK, ("G64", *FACETS), Cause.BLOCK_TIME, 95.0, keys=SLOW_BLOCKS),
    "blocks, SOFT": Case(SINUMERIK, ("G64 SOFT", *FACETS), Cause.BLOCK_TIME, 90.0, keys=SLOW_BLOCKS),
    "corner, BRISK": Case(SINUMERIK, ("G64 BRISK", *TURN), Cause.CORNERS, 2.0),
    "corner, meldas": Case(MELDAS, ("G64", *TURN), Cause.CORNERS, 2.0),
    "corner, syntec": Case(SYNTEC, ("G64", *TURN), Cause.CORNERS, 2.0),
    "1783": Case(FANUC, look_ahead(*ZIGZAG), Cause.CORNER_STEP, 20.0, "Y", {"1783[Y]": 30}),
    "Pr406": Case(SYNTEC, ("G64", *ZIGZAG), Cause.CORNER_STEP, 20.0, "Y", {"406": 30}),
    "1737": Case(FANUC, look_ahead(*ZIGZAG), Cause.LINE_PULL, 60.0, "Y", {"1737[Y]": 100}),
    "1735": Case(FANUC, look_ahead("G2 X40. R20. F9000."), Cause.ARC_PULL, 80.0, "", {"1735[X]": 100}),
    "Pr408": Case(SYNTEC, ("G2 X40. R20. F9000.",), Cause.ARC_PULL, 80.0, "", {"408": 100}),
    "curve, BRISK": Case(
        SINUMERIK, ("BRISK G64", "G2 X2 Y0 CR=1 F6000", "X0 CR=1"), Cause.CURVATURE, 40.0, "Y"
    ),
    "curve, ACC": Case(
        SINUMERIK, ("ACC[X]=10 ACC[Y]=10", "G64 G2 X40 Y0 CR=20 F12000"), Cause.CURVATURE, 30.0, "Y"
    ),
    "F on a curve, ACC": Case(
        SINUMERIK, ("ACC[X]=10 ACC[Y]=10", "G64 G2 X40 Y0 CR=20 F2000"), Cause.FEED, 80.0
    ),
    "velocity on a curve, ACC": Case(
        SINUMERIK, ("ACC[X]=50 VELOLIM[X]=2", "G64 G2 X400 Y0 CR=200 F12000"), Cause.PROGRAM_AXIS, 95.0, "X"
    ),
    "velocity on a curve, SOFT": Case(
        SINUMERIK,
        ("SOFT VELOLIM[X]=2", "G64 G2 X400 Y0 CR=200 F12000", "X0 CR=200"),
        Cause.PROGRAM_AXIS,
        90.0,
        "X",
    ),
    "curve, SOFT": Case(SINUMERIK, ("SOFT G64", "G2 X0 I20 F40000 TURN=3"), Cause.CURVATURE, 40.0, "X"),
    "ACC": Case(SINUMERIK, ("ACC[X]=10", "G1 X5 F6000"), Cause.ACCELERATION, 45.0, "X"),
    "acceleration, SOFT": Case(SINUMERIK, ("SOFT", "G1 X150 F90000"), Cause.ACCELERATION, 5.0, "X"),
    "tap": Case(FANUC, ("M29 S6000", "G84 Z-20. R2. F6000."), Cause.SPINDLE_PULL, 10.0),
    "jerk, fanuc": Case(FANUC, ("G1 X1. F6000.",), Cause.JERK, 20.0, "X"),
    "jerk, SOFT": Case(SINUMERIK, ("SOFT", "G64 G1 X1 F6000", "X2"), Cause.JERK, 40.0, "X"),
    "jerk of corners, fanuc": Case(FANUC, ("G64", *ZIGZAG), Cause.CORNER_JERK, 20.0, "Y"),
    "jerk of corners, SOFT": Case(SINUMERIK, ("SOFT G642", *ZIGZAG), Cause.CORNER_JERK, 20.0, "Y"),
    "settling": Case(FANUC, ("G1 X1. F6000.",), Cause.SETTLING, 20.0),
    "after the interpolation": Case(
        FANUC, ("G1 X100. F6000.",), Cause.TIME_CONSTANT, 5.0, "", {"1622[X]": 100, "1610[X]": "00000001"}
    ),
    "exact stop, fanuc": Case(FANUC, ("G61", *TURN), Cause.STANDSTILL, 5.0),
    "exact stop, lathe": Case(LATHE, ("G98 G1 Z-50. F3000.",), Cause.STANDSTILL, 1.0, machine="lathe2"),
    "exact stop, meldas": Case(MELDAS, ("G61", *TURN), Cause.STANDSTILL, 5.0),
    "exact stop, syntec": Case(SYNTEC, ("G61", *TURN), Cause.STANDSTILL, 5.0),
    "exact stop, sinumerik": Case(SINUMERIK, ("G60", *TURN), Cause.STANDSTILL, 5.0),
    "rapid, fanuc": Case(FANUC, ("G0 X300.",), Cause.RAPID, 60.0, "X"),
    "rapid, lathe": Case(LATHE, ("G0 Z-150.",), Cause.RAPID, 30.0, "Z", machine="lathe2"),
    "rapid, meldas": Case(MELDAS, ("G0 X300.",), Cause.RAPID, 60.0, "X"),
    "rapid, syntec": Case(SYNTEC, ("G0 X300.",), Cause.RAPID, 60.0, "X"),
    "rapid, sinumerik": Case(SINUMERIK, ("G0 X300",), Cause.RAPID, 60.0, "X"),
    "1420": Case(FANUC, ("G0 X300.",), Cause.RAPID, 95.0, "X", {"1420[X]": 1000}),
    "Pr461": Case(SYNTEC, ("G0 X300.",), Cause.RAPID, 95.0, "X", {"461": 1000}),
}


def run(case: Case, folder: Path) -> tuple[TimeAccount, float]:
    """A case's account of time, and the seconds of its motion."""
    machine: Path | str = case.machine
    if case.keys:
        machine = folder / "machine.toml"
        machine.write_text(f'base = "{case.machine}"\n{case.keys}', encoding="ascii")
    head = ("O1",) if case.control in (FANUC, LATHE, MELDAS) else ()
    session = open_session(
        "\n".join([*head, *case.lines, "M30", ""]).encode(),
        control=case.control,
        machine=machine,
        setup={"parameters": case.parameters, "tools": {1: {"length": 50.0}}},
        keep=False,
    )
    account = session.explain_time()
    result = session.run()
    assert result.ok, [result.alarm_text(alarm) for alarm in session.channel.alarms]
    times = result.plan.times
    moved = times.cutting_s + times.rapid_s
    parts = account.parts.values()
    assert sum(part.seconds for part in parts) == pytest.approx(moved, rel=1e-9)
    assert sum(part.way for part in parts) == pytest.approx(times.cutting_mm + times.rapid_mm, rel=1e-9)
    return account, moved


@pytest.mark.parametrize("name", CASES)
def test_the_limit_that_holds_is_named(name: str, tmp_path: Path) -> None:
    case = CASES[name]
    account, moved = run(case, tmp_path)
    held = account.by_axis[case.cause][case.axis].seconds
    told = {
        (str(c), a): 100.0 * p.seconds / moved for c, of in account.by_axis.items() for a, p in of.items()
    }
    assert 100.0 * held / moved >= case.least, {key: share for key, share in told.items() if share > 0.0}


def test_every_cause_has_a_case_but_what_lies_over_axes() -> None:
    assert set(Cause) - {case.cause for case in CASES.values()} == {Cause.OVERLAID}


def fields() -> Iterable[str]:
    """All that the planner reads of rows, contexts, limits and paces."""
    for group in (Rows, Limits):
        yield from (f"{group.__name__}.{name}" for name in group._fields)
    yield from (f"PathLimits.{name}" for name in PathLimits.__annotations__)
    yield from (f"ContextRecord.{name}" for name in vars(ContextRecord) if name.isupper() and name != "SIZE")
    yield from (f"Pace.{name}" for name in Pace.__annotations__)


def test_the_account_knows_every_bound_of_the_planner() -> None:
    assert set(BOUNDS) == set(fields())


def test_every_cause_is_one_of_a_bound() -> None:
    assert {cause for causes in BOUNDS.values() for cause in causes} == set(Cause)


def test_kernels_and_python_number_causes_alike() -> None:
    assert issubclass(Held, Places)
    assert [getattr(Held, cause.name) for cause in Cause] == list(range(len(Cause)))


@pytest.mark.parametrize("cause", Cause)
def test_every_cause_has_words(cause: Cause) -> None:
    assert text(f"run.explained.{cause}", axis="X")


@pytest.mark.skipif(LIBRARY.lack is not None, reason="needs compiled kernels")
@pytest.mark.parametrize("name", CASES)
def test_compiled_kernels_count_the_same(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    by_code = run(CASES[name], tmp_path)[0].by_axis
    monkeypatch.setattr(LIBRARY, "kernel", LIBRARY.plain)
    by_python = run(CASES[name], tmp_path)[0].by_axis
    assert by_code == by_python

"""A program that nobody disturbs."""

from __future__ import annotations

from pathlib import Path

import pytest

import polycnc
from polycnc.mainrun import State, VirtualControl
from tests.mainrun.support import MILL, execution_of, power_on, recorded, run_through

EXAMPLES = Path(__file__).parents[3] / "examples"
CONTROLS = {
    "fanuc-0i-tf": "fanuc-0i-tf", "fanuc-m": "fanuc-m", "meldas-m": "meldas-m",
    "sinumerik-840d": "sinumerik-840d", "syntec-mill": "syntec-mill",
}  # fmt: skip


def examples() -> list[Path]:
    return [path for path in sorted(EXAMPLES.iterdir()) if path.suffix in (".nc", ".mpf")]


def setup_of(path: Path) -> Path | None:
    setup = path.with_suffix("").with_suffix(".setup.yaml")
    return setup if setup.exists() else None


def control_of(path: Path) -> str:
    return next(name for name in CONTROLS if path.name.startswith(name))


@pytest.mark.parametrize("path", examples(), ids=lambda path: path.name)
def test_the_clock_says_what_the_planner_says(path: Path) -> None:
    result = polycnc.run(path, control=control_of(path), setup=setup_of(path))
    planned = result.plan
    virtual = VirtualControl(control_of(path), setup=setup_of(path))
    virtual.load(path)
    records = recorded(virtual)
    assert run_through(virtual) is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    parallel = 0.01 * planned.total_s  # beside what waits for functions that run with the motion
    assert end == pytest.approx(planned.total_s, rel=1e-6, abs=parallel)


ARC = {"sinumerik-840d": "CR=10."}
#: A dwell of half a second.
DWELL = {"sinumerik-840d": "G4 F0.5"}
METRIC = {"sinumerik-840d": "G71 G90", "syntec-mill": "G71 G90", "fanuc-0i-tf": "G21 G98"}
#: Control and, on SINUMERIK, the acceleration mode.
LEADS = [
    *((control, "") for control in CONTROLS if control != "sinumerik-840d"),
    ("sinumerik-840d", "BRISK"),
    ("sinumerik-840d", "SOFT"),
]
SAME_TIME = {
    "line": "G1 X50. F1500.\nM30\n",
    "corner": "G1 X25. F1500.\nZ25.\nM30\n",
    "facets": "G1 F3000.\nX5. Z0.2\nX10. Z0.8\nX15. Z1.8\nX20. Z3.2\nM30\n",
    "rapid and cut": "G0 X50. Z20.\nG1 Z-5. F300.\nX80. F2000.\nG0 Z50.\nM30\n",
    "exact stop": "G9 G1 X10. F2000.\nZ10.\nM30\n",
    "dwell": "G1 X10. F1000.\n{dwell}\nX20.\nM30\n",
    "arc between lines": "G1 X20. F1500.\nG3 X30. Y10. {r}\nG1 Y40.\nM30\n",
    "arc from rest to rest": "G3 X10. Y10. {r} F1500.\nM30\n",
    "lines in one direction": "G1 X25. F1500.\nX50.\nM30\n",
    "another feed": "G1 X20. F1500.\nX40. F3000.\nM30\n",
}


def times(control: str, mode: str, body: str) -> tuple[float, float]:
    """Planned time, and that of the main run."""
    head = METRIC.get(control, "G21 G90")
    text = (
        f"{head} G64 {mode}\n{body.format(r=ARC.get(control, 'R10.'), dwell=DWELL.get(control, 'G4 P500'))}"
    )
    virtual = power_on(text, control)
    records = recorded(virtual)
    assert run_through(virtual) is State.READY
    end = next(record.time for record in reversed(records) if record.what == "state")
    return polycnc.run(text.encode(), control=control).time, end


def lacks_axis(body: str, control: str) -> bool:
    """Whether a program moves Y on a lathe, which has none."""
    return "Y" in body and control == "fanuc-0i-tf"


@pytest.mark.parametrize(("control", "mode"), LEADS)
@pytest.mark.parametrize("body", SAME_TIME.values(), ids=SAME_TIME)
def test_a_program_takes_the_planned_time_on_every_control(control: str, mode: str, body: str) -> None:
    if lacks_axis(body, control):
        pytest.skip("a lathe has no Y")
    planned, run = times(control, mode, body)
    assert run == pytest.approx(planned, rel=1e-6)
    assert planned > 0.1


#: A run that leads to a row that turns back on the one before by more than 170° ends there: the row stands alone.
TURN_BACK = {
    "arc behind a line": "G1 X10 F3000\nG2 X5 Y0.5 CR=20\n",
    "spline behind a line": "G1 X10 F3000\nASPLINE X4 Y0.5\nX3 Y4\nX8 Y9\nG1 X20\n",
    "line behind an arc": "G3 X10 Y10 J10 F3000\nG1 X10.8 Y0\n",
    "line between arcs": "G3 X10 Y10 J10 F3000\nG1 X10.8 Y0\nG2 X10.5 Y10 CR=30\nG1 X30\n",
    "line between lines": "G1 X10 F3000\nX2 Y1\nX10 Y1.5\nY20\n",
}


@pytest.mark.parametrize("corners", ["G64", "G641 ADIS=0.5", "G642"])
@pytest.mark.parametrize("body", TURN_BACK.values(), ids=TURN_BACK)
def test_a_line_that_a_law_leaves_alone_runs_from_rest_to_rest(corners: str, body: str) -> None:
    planned, run = times("sinumerik-840d", f"SOFT\n{corners}", body + "M30\n")
    assert run == pytest.approx(planned, rel=1e-6)


def after_reference(virtual: VirtualControl) -> list[tuple[float, str, object]]:
    """Run the program from the reference point; what it prints may count the runs."""
    virtual.select_mode("reference")
    virtual.home()
    virtual.run()
    virtual.select_mode("auto")
    start, records = virtual.time, recorded(virtual)
    run_through(virtual)
    virtual.listeners.clear()
    return [(round(r.time - start, 6), r.what, r.data) for r in records if r.data.get("type") != "print"]


@pytest.mark.parametrize("path", examples(), ids=lambda path: path.name)
def test_nothing_of_a_run_is_left_in_the_next(path: Path) -> None:
    virtual = VirtualControl(control_of(path), setup=setup_of(path))
    virtual.load(path)
    after_reference(virtual)  # the first one changes the tool that is in the spindle
    assert after_reference(virtual) == after_reference(virtual)


def test_stepping_gives_the_same_as_running() -> None:
    whole, stepped = power_on(), power_on()
    one, other = recorded(whole), recorded(stepped)
    whole.cycle_start()
    whole.run()
    stepped.cycle_start()
    while stepped.state is State.RUNNING:
        stepped.step(0.012)
    assert one == other


def test_no_piece_is_ticked_through() -> None:
    virtual = power_on("O1\nG1 X100. F1.\nM30\n")
    steps = 0
    advance = execution_of(virtual).advance

    def counted(until: float, *, freely: bool = False) -> None:
        nonlocal steps
        steps += 1
        advance(until, freely=freely)

    execution_of(virtual).advance = counted  # type: ignore[method-assign]
    virtual.cycle_start()
    virtual.run()
    assert virtual.time > 5000.0
    assert steps < 20


def test_the_end_position_is_that_of_the_plain_run() -> None:
    virtual = power_on()
    run_through(virtual)
    final = polycnc.run(MILL, control="fanuc-m").final
    assert virtual.positions.work == pytest.approx(final["work"])
    assert virtual.positions.machine == pytest.approx(final["machine"])


SLOW_TO_SETTLE = 'base = "mill3"\nsettle_fine_s = 0.5\n'


@pytest.mark.parametrize("end", ["", "M30\n"])
def test_the_axes_settle_behind_the_last_row_with_and_without_a_program_end(tmp_path: Path, end: str) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(SLOW_TO_SETTLE, encoding="utf-8")
    text = f"G90 G60 G1 X10 F6000\nG1 X20\n{end}"
    planned = polycnc.run(text.encode(), control="sinumerik-840d", machine=file).plan
    virtual = power_on(text, "sinumerik-840d", machine=file)
    records = recorded(virtual)
    assert run_through(virtual) is State.READY
    assert next(r.time for r in reversed(records) if r.what == "state") == pytest.approx(planned.total_s)
    assert planned.total_s > 1.0


def test_what_a_given_up_program_waited_for_is_no_wait_of_the_next(tmp_path: Path) -> None:
    file = tmp_path / "machine.toml"
    file.write_text(SLOW_TO_SETTLE, encoding="utf-8")
    virtual = power_on("G90 G60 G1 X10 F6000\nSTOPRE\nX20\nM30\n", "sinumerik-840d", machine=file)
    virtual.cycle_start()
    virtual.step(0.004)
    virtual.reset()
    virtual.run()
    virtual.load("M5\nM30\n")
    started = virtual.time
    records = recorded(virtual)
    assert run_through(virtual) is State.READY
    assert next(r.time for r in reversed(records) if r.what == "state") < started + 0.4

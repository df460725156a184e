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

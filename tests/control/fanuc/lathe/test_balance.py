"""Balance cutting on a lathe of two paths."""

from __future__ import annotations

from polycnc.control.fanuc.lathe.states import BalanceState
from polycnc.session import Result, open_session


def run(first: str, second: str, **parameters: int) -> Result:
    """The result of both paths, path 2 with a program of its own."""
    setup = {"machine": "lathe2-2path", "parameters": parameters}
    files = {"MAIN.P-2": second}
    return open_session(first + "\n", control="fanuc-0i-tf", setup=setup, files=files).run()


def z_of_second_path(result: Result) -> float:
    assert result.channel.group is not None
    return result.channel.group.channel(2).coordinates.position[1]


def test_further_paths_start_with_the_first_one() -> None:
    result = run("G0 Z1.\nG68\nG69\nM30", "G0 Z5.\nG68\nG69\nM30")
    assert not result.alarms
    assert z_of_second_path(result) == 5.0


def test_a_path_cuts_only_as_often_as_the_other_one() -> None:
    first = "G98 G0 Z1.\nG68\nG1 Z-1. F100\nG69\nM30"
    second = "G98\nG68\nG1 Z-5. F100\nZ-6.\nZ-7.\nG69\nM30"
    result = run(first, second)
    assert [alarm.code for alarm in result.alarms] == ["PC0005"]
    assert z_of_second_path(result) == -5.0  # in front of the next block it waits for ever


def test_rapids_and_blocks_without_travel_do_not_wait() -> None:
    first = "G98 G0 Z1.\nG68\nG1 Z-1. F100\nG69\nM30"
    second = "G98\nG68\nG0 Z4.\nG1 Z4. F100\nG1 Z-5.\nG0 Z3.\nG1 Z-8.\nG0 Z9.\nM30"
    assert z_of_second_path(run(first, second)) == 3.0  # in front of its second cut it waits for ever


def test_a_reset_ends_balance_cutting() -> None:
    result = run("G68\nM30", "G68\nM30")
    assert result.channel.mode["turret_mirror"] == "G68"
    result.control.reset(result.channel)
    assert result.channel.mode["turret_mirror"] == "G69"
    assert not BalanceState.of(result.channel).paths

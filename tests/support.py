"""Short ways to run a program in a test."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from polycnc.channel.channel import Channel
from polycnc.channel.group import ChannelGroup
from polycnc.control.registry import control
from polycnc.machine import load_machine, parse_setup
from polycnc.program import Form, ProgramStore
from polycnc.toolpath import Row, Toolpath

MACHINES = Path(__file__).parent / "conformance" / "machines"
#: Hartford's rules on machines with rotary axes.
HARTFORD_MILL4 = str(MACHINES / "hartford-mill4.toml")
HARTFORD_MILL5 = str(MACHINES / "hartford-mill5-ac-table.toml")
MAIN = "/_N_WKS_DIR/_N_TEST_WPD/_N_MAIN_MPF"


def run(
    text: str,
    control_id: str = "fanuc-m",
    *,
    setup: Mapping[str, Any] | None = None,
    machine: str = "",
    chunk_rows: int = 65_536,
    block_limit: int = 1_000_000,
) -> Channel:
    """Run a program to its end and give the channel."""
    chosen = control(control_id)
    store = ProgramStore(form=chosen.form)
    program = store.add_text(MAIN if chosen.form is Form.SINUMERIK else "MAIN", text)
    built = load_machine(machine or chosen.default_machine)
    toolpath = Toolpath(built.channel_axes(1), chunk_rows=chunk_rows)
    channel = Channel(chosen, built, parse_setup(setup), store, block_limit=block_limit, toolpath=toolpath)
    for _ in ChannelGroup(channel).run(program):
        pass
    return channel


def moves(channel: Channel) -> list[Row]:
    """The rows that are moves."""
    return [row for row in channel.toolpath.rows() if row.event is None]


def ends(channel: Channel) -> list[tuple[float, ...]]:
    """End points of all moves, rounded to 1e-6."""
    return [tuple(round(value, 6) + 0.0 for value in row.end) for row in moves(channel)]


def codes(channel: Channel) -> list[str]:
    """Codes of all alarms."""
    return [alarm.code for alarm in channel.alarms]

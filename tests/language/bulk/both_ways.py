"""Runs a program with the scanner and without it, and says where the results differ."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from math import inf
from typing import Any

from polycnc.channel.channel import Channel
from polycnc.control.registry import control
from polycnc.language.bulk.kernels import scan
from polycnc.language.bulk.layout import Columns, State, Tables
from polycnc.language.bulk.settings import Bulk
from polycnc.machine import load_machine
from polycnc.machine.setup.file import parse_setup
from polycnc.program import Form, ProgramStore
from tests.kernels.strict import strict

plain_scan = strict(scan)
#: The kernel as it is written, from the first line on.
PLAIN = Bulk(fewest_lines=0, scan=plain_scan, rooms=200, most_patience=1)
machine = cache(load_machine)
COLUMNS = ("kind", "program", "line", "context", "feed", "end", "curve", "curves")


def run(
    text: str,
    control_id: str,
    setup: Mapping[str, Any] | None = None,
    bulk: Bulk | None = None,
    *,
    travel: float = inf,
    files: Mapping[str, str] | None = None,
    **limits: Any,
) -> Channel:
    """Run a program to its end; programmed stops are started again.

    `travel` limits every axis to either side, `files` are further programs by their names.
    """
    built = control(control_id)
    store = ProgramStore(form=built.form)
    name = "/_N_WKS_DIR/_N_TEST_WPD/_N_MAIN_MPF" if built.form is Form.SINUMERIK else "MAIN"
    program = store.add_text(name, text)
    for key, content in (files or {}).items():
        store.add_text(key, content)
    start = parse_setup(setup or {})
    chosen = machine(start.machine or built.default_machine)
    if travel < inf:
        axes = (replace(axis, limit_minus=-travel, limit_plus=travel) for axis in chosen.axes)
        chosen = replace(chosen, axes=tuple(axes))
    channel = Channel(built, chosen, start, store, bulk=bulk, **limits)
    for _ in channel.run(program):
        pass
    return channel


def scanned(
    text: str,
    control_id: str,
    setup: Mapping[str, Any] | None = None,
    *,
    bulk: Bulk = PLAIN,
    **limits: Any,
) -> int:
    """How many blocks of a program the scanner takes."""
    taken = 0

    def scan(tables: Tables, state: State, columns: Columns) -> int:
        nonlocal taken
        outcome = plain_scan(tables, state, columns)
        taken += state.scan.blocks
        return outcome

    run(text, control_id, setup, replace(bulk, scan=scan), **limits)
    return taken


def bits(numbers: Any) -> list[str]:
    """Numbers so that equal ones are equal bit for bit."""
    return [float(number).hex() for number in numbers]


def outcome(channel: Channel) -> dict[str, Any]:
    """All that a run leaves behind."""
    toolpath, c = channel.toolpath, channel.coordinates
    told: dict[str, Any] = {
        name: b"".join(getattr(chunk, name).tobytes() for chunk in toolpath.chunks) for name in COLUMNS
    }
    told |= {
        "events": [repr(event) for chunk in toolpath.chunks for event in chunk.events],
        "contexts": toolpath.contexts,
        "programs": toolpath.programs,
        "alarms": channel.alarms,
        "blocks": channel.blocks,
        "position": bits(c.position),
        "programmed": bits(c.programmed),
        "pending": bits(c.pending),
        "feed": bits([channel.feed]),
        "mode": channel.mode.codes,
        "variables": variables(channel),
    }
    return told


def variables(channel: Channel) -> dict[str, str]:
    """Variables of the control that hold something at the end."""
    control = channel.control
    return {name: repr(control.read_variable(channel, name)) for name in control.variable_names(channel)}


def differences(
    text: str, control_id: str, setup: Mapping[str, Any] | None = None, bulk: Bulk = PLAIN, **limits: Any
) -> list[str]:
    """Names of what differs between both ways."""
    one = outcome(run(text, control_id, setup, **limits))
    other = outcome(run(text, control_id, setup, bulk, **limits))
    return [name for name in one if one[name] != other[name]]

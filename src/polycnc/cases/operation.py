"""Cases with an operator: the commands of a case's `operate` are given to a virtual control, one after the other.

A step is the name of a command of `VirtualControl`, alone (`cycle_start`) or with what it takes: a mapping
(`override: {feed: 0.5}`), a list (`jog: [X, 1]`), or one value (`select_mode: jog`). Time passes in `step: SECONDS`,
and in `run`, which ends when the control stands.
"""

from __future__ import annotations

from inspect import signature

from polycnc.cases import compare
from polycnc.cases.format import CaseError
from polycnc.control import registry
from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING, cast
from polycnc.mainrun import CommandRefused, VirtualControl
from polycnc.messages import AlarmError, text

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from polycnc.cases.format import Case, Step
    from polycnc.mainrun import Record
    from polycnc.memory.retained import RetainedStore
    from polycnc.messages import Alarm
    from polycnc.toolpath import trace

#: A run that has not come to an end after this simulated time is given up, s.
LIMIT_S = 3600.0


@dataclass
class Operator:
    """Works a virtual control and remembers what it refused.

    Attributes:
        control: The control, with the case's program loaded.
        refused: Names of the commands that were refused, in order.
        events: What the programs have put out, as the trace has it.
    """

    control: VirtualControl
    refused: list[str] = field(default_factory=list)
    events: list[trace.Record] = field(default_factory=list)

    def hears(self, record: Record) -> None:
        """Keep the events among what happens."""
        if record.what == "event":
            self.events.append(cast("trace.Record", record.data))

    def does(self, step: Step) -> None:
        """Give one command; a refusal is remembered.

        Raises:
            CaseError: The command does not take what the case gives it.
        """
        name, given = (step, None) if isinstance(step, str) else next(iter(step.items()))
        try:
            if name == "run":
                self.control.run(limit_s=LIMIT_S)
            else:
                _call(name, cast("Callable[..., object]", getattr(self.control, name)), given)
        except CommandRefused:
            self.refused.append(name)


def _call(name: str, command: Callable[..., object], given: object) -> None:
    named: dict[str, object] = given if isinstance(given, dict) else {}
    listed: list[object] = [] if given is None or named else given if isinstance(given, list) else [given]
    try:
        signature(command).bind(*listed, **named)
    except TypeError as error:
        key = f"operate.{name}"
        raise CaseError(text("case.wrong-value", name=key, value=repr(given), reason=error)) from None
    command(*listed, **named)


def operated(case: Case, folder: Path, memory: RetainedStore | None = None) -> list[str]:
    """Load the program of a case, give the commands of its operator, and tell what differs at the end.

    Args:
        case: The case.
        folder: The folder of its file.
        memory: What the control has kept from before; None for nothing.
    """
    control = VirtualControl(
        case.control, setup=_beside(case.setup, folder), files=case.files, retained=memory
    )
    control.load(case.program.removesuffix("\n") + "\n")
    operator = Operator(control)
    control.listeners.append(operator.hears)
    for step in case.operate:
        operator.does(step)
    expect = case.expect
    differences = compare.compare_alarms(
        registry.control(case.control),
        expect.alarms,
        control.alarms,
        lambda alarm: alarm.block,
        lambda a: _shown(control, a),
    )
    if expect.final is not None:
        shown = control.positions
        positions = compare.Positions(expect.tolerance)
        differences += compare.compare_final(expect.final, shown.work, shown.machine, positions)
    differences += compare.compare_variables(expect.variables, _reader(control), expect.tolerance)
    differences += compare.compare_events(expect.events, operator.events, expect.tolerance)
    return differences + _panel_differences(case, operator)


def _reader(control: VirtualControl) -> Callable[[str], object]:
    """Reads a variable as programs name it; `KeyError` for a name that is none."""

    def read(name: str) -> object:
        try:
            return control.read_variable(name)
        except AlarmError:
            raise KeyError(name) from None

    return read


def _panel_differences(case: Case, operator: Operator) -> list[str]:
    """What the panel shows at the end, and what was refused on the way."""
    control, wanted = operator.control, case.expect.panel
    came: dict[str, object] = {
        "state": str(control.state),
        "mode": str(control.mode),
        "time": control.time,
        "spindle": control.spindle.rpm,
        "parts": control.snapshot.parts,
        "refused": operator.refused,
    }
    shown: dict[str, object] = wanted.model_dump(exclude_none=True)
    return [
        text("case.panel-differs", name=name, expected=value, came=came[name])
        for name, value in shown.items()
        if not compare.values_equal(value, came[name], max(case.expect.tolerance, wanted.tolerance))
    ]


def _beside(setup: dict[str, object], folder: Path) -> dict[str, object]:
    """The setup with a machine file looked up beside the case file."""
    machine = setup.get("machine")
    found = folder / str(machine) if machine is not None else None
    return setup | {"machine": str(found)} if found is not None and found.is_file() else setup


def _shown(control: VirtualControl, alarm: Alarm) -> str:
    return f"{alarm.code} {control.alarm_text(alarm)} ({alarm.program}:{alarm.line})"

"""What an operator has done, and doing it again: lines of JSON, each a message of the interface with its time.

The first line says which control it was. A control does the same again where it begins with the same machine, setup and
memory: commands act at simulated times, and nothing depends on the time of day.
"""

from __future__ import annotations

import json
from collections import deque
from contextlib import suppress

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import UserError

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from polycnc.mainrun import VirtualControl


class RecordingError(UserError):
    """A recording cannot be used."""


class Recording:
    """What has been done at a control, in order.

    Args:
        control: The control.

    Attributes:
        acts: Every act with its simulated time, s: `{"at": 1.5, "do": "press", "with": {"keys": ["START"]}}`.
    """

    def __init__(self, control: VirtualControl) -> None:
        self._control = control
        self.acts: list[dict[str, Any]] = []

    def note(self, do: str, /, **given: Any) -> None:
        """Something is done now."""
        self.acts.append({"at": self._control.time, "do": do, "with": given})

    def text(self) -> str:
        """The lines of its file."""
        head = {"polycnc": 1, "control": self._control.control.id, "machine": self._control.machine.id}
        return "".join(json.dumps(each, ensure_ascii=False) + "\n" for each in (head, *self.acts))


class Replay:
    """Does again what was recorded, while time passes.

    Args:
        control: The control.
        acts: What was done.
        perform: Does an act: its name and its arguments. What the control refuses now it refused then.
    """

    def __init__(
        self,
        control: VirtualControl,
        acts: list[dict[str, Any]],
        perform: Callable[[str, Mapping[str, Any]], object],
    ) -> None:
        self._control, self._perform = control, perform
        self._acts = deque(acts)

    @property
    def is_over(self) -> bool:
        """Whether all is done."""
        return not self._acts

    def step(self, seconds: float, pass_time: Callable[[float], object]) -> None:
        """Let time pass, and do on the way what is due."""
        end = self._control.time + seconds
        while self._acts and self._acts[0]["at"] <= end:
            act = self._acts.popleft()
            way = act["at"] - self._control.time
            if way > 0.0:
                pass_time(way)
            with suppress(UserError):
                self._perform(act["do"], act["with"])
        if end > self._control.time:
            pass_time(end - self._control.time)


def load_acts(path: Path, control: str) -> list[dict[str, Any]]:
    """What a file has recorded.

    Raises:
        RecordingError: It cannot be read, or is of another control.
    """
    try:
        head, *acts = [json.loads(line) for line in path.read_text(encoding="utf-8").splitlines()]
        known = str(head["control"]) if head["polycnc"] == 1 else ""
        usable = all(
            isinstance(act["at"], int | float)
            and isinstance(act["do"], str)
            and isinstance(act["with"], dict)
            for act in acts
        )
    except OSError as error:
        raise RecordingError("file.unreadable", file=path, reason=error.strerror) from error
    except (ValueError, TypeError, KeyError, AttributeError) as error:
        raise RecordingError("recording.form", file=path) from error
    if known != control:
        raise RecordingError("recording.control", file=path, held=known, wanted=control)
    if not usable:
        raise RecordingError("recording.form", file=path)
    return acts

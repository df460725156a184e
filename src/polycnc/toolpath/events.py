"""What happens between moves: spindle, tool, auxiliary functions, messages, stops and alarms."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(frozen=True, slots=True)
class Event:
    """One event. `type` and `data` are what the trace shows.

    `m {code}`, `s {speed, spindle}`, `t {tool}`, `h {code}`, `message {text}`, `print {text}`, `stop {code}`,
    `alarm {code, line, text}`.
    """

    type: str
    data: Mapping[str, Any] = field(default_factory=dict)

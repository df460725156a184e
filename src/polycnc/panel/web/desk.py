"""A control with its screen and its machine panel, and the time that passes for them; all browsers share one desk."""

from __future__ import annotations

from contextlib import suppress
from math import ceil
from time import monotonic

from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.mainrun import CommandRefused, State
from polycnc.messages import UserError
from polycnc.panel.course import Course
from polycnc.panel.panel import Panel
from polycnc.panel.screens.card import Card
from polycnc.panel.screens.screen import Screen
from polycnc.panel.teaching.faults import inject
from polycnc.panel.teaching.recording import Recording

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from polycnc.mainrun import VirtualControl
    from polycnc.panel.panel import Light
    from polycnc.panel.screens.view import View
    from polycnc.panel.teaching.lesson import Lesson
    from polycnc.panel.teaching.recording import Replay

#: The trail of the picture has a point at the end of every part of the time, simulated s; of so many parts at most.
PART_S, PARTS = 0.02, 16
#: No longer than this passes at once, s: a browser that has slept does not make the machine jump.
LONGEST_TICK_S = 0.25
#: The key of the machine panel that starts what was typed in at MDI.
_START = "START"
#: The panel's own settings: positions of its switches (the mode is as after power-on), language of pages, display.
_SWITCHES, _LANGUAGE, _UNIT = "switches", "language", "mdi_unit"


@dataclass(frozen=True, slots=True)
class Look:
    """What there is to be seen at one moment, in one language.

    Attributes:
        view: The screen.
        lamps: What every lamp shows.
        dim: Keys of the machine panel that would do nothing now.
        tools: What the tool display says.
    """

    view: View
    lamps: Mapping[str, Light]
    dim: frozenset[str]
    tools: str


class Desk:
    """What an operator sits at.

    Args:
        control: The control.
        speed: Simulated seconds in a second.
        card: The folder that is its memory card; None for none.

    Attributes:
        control: The control.
        screen: Its screen.
        panel: Its machine panel.
        speed: Simulated seconds in a second.
        course: What its picture shows.
        recording: What has been done at it.
        replay: What does again what was recorded; None where people do it.
        lesson: The exercise that is worked on; None for none.
    """

    def __init__(self, control: VirtualControl, speed: float = 1.0, card: Path | None = None) -> None:
        self.control = control
        self.screen = Screen(control)
        self.screen.card = Card(card)
        self.panel = Panel(control)
        self.course = Course(control)
        self.recording = Recording(control)
        self.replay: Replay | None = None
        self.lesson: Lesson | None = None
        if self.screen.measuring is not None:
            measuring = self.screen.measuring
            self.panel.locked = lambda: measuring.locked
        self.speed = speed
        self._then = monotonic()
        self._looks: dict[str, Look] = {}
        units = self.panel.description.mdi_units
        self._unit = next((each.id for each in units if each.soft_keys == self.screen.rows), "")
        kept = control.panel_settings.get(_SWITCHES, {})
        for switch, position in kept.items():
            if switch in self.panel.positions:
                with suppress(UserError):
                    self._turn(switch, position)
        if kept_unit := control.panel_settings.get(_UNIT):
            self.unit = str(kept_unit)

    @property
    def unit(self) -> str:
        """Id of the display with its keys; another one has more or fewer soft keys. Empty where there is no choice."""
        return self._unit

    @unit.setter
    def unit(self, name: str) -> None:
        for each in self.panel.description.mdi_units:
            if each.id == name:
                self._unit = name
                self.screen.use_display(each.soft_keys, each.side_keys)
                self.control.panel_settings[_UNIT] = name

    @property
    def language(self) -> str:
        """The language that was chosen last on a page; empty for none."""
        return str(self.control.panel_settings.get(_LANGUAGE, ""))

    @language.setter
    def language(self, lang: str) -> None:
        self.control.panel_settings[_LANGUAGE] = lang

    def look(self, lang: str) -> Look:
        """What there is to be seen now: made once for all browsers, until time passes or something is done."""
        look = self._looks.get(lang)
        if look is None:
            panel = self.panel
            dim = frozenset(name for name in panel.description.keys if panel.why_not(name) is not None)
            look = Look(self.screen.view(lang), panel.lamps(), dim, panel.tool_text(lang))
            self._looks[lang] = look
        return look

    def tick(self) -> None:
        """Let the time pass that has passed since the last call."""
        now = monotonic()
        seconds, self._then = min(now - self._then, LONGEST_TICK_S) * self.speed, now
        cycle = self.control.machine.interpolation_cycle_s
        if seconds < cycle:
            self._then = now - seconds / self.speed
            return
        try:
            if self.replay is not None:
                self.replay.step(seconds, self._pass)
            else:
                self._pass(seconds)
        except UserError as error:  # what is to last cannot be written down: the memory file tells why
            self.screen.refusal = error
        self.screen.follow()
        self.course.go_on()
        self._looks.clear()

    def _pass(self, seconds: float) -> None:
        """Let simulated time pass, with points on the trail of the picture."""
        parts = max(1, min(PARTS, ceil(seconds / PART_S)))
        for _ in range(parts):
            self.control.step(seconds / parts)
            self.course.note(self.control.snapshot)
            self.follow()

    def follow(self) -> None:
        """The exercise looks at the control: behind everything that is done, and while time passes."""
        self._looks.clear()
        if self.lesson is not None:
            self.lesson.follow()

    # ---- what is done at it --------------------------------------------------------------------------------

    def do(self, name: str, /, **given: Any) -> None:
        """Do one of `actions`, as a page does: it is recorded, and what is refused is the screen's message."""
        self.recording.note(name, **given)
        self.screen.refusal = None
        try:
            self.actions[name](*given.pop("keys", ()), **given)
        except UserError as refusal:
            self.screen.refusal = refusal
        if self.lesson is not None and self.screen.refusal is not None:
            self.lesson.refused += 1
        self.follow()

    @property
    def actions(self) -> Mapping[str, Callable[..., object]]:
        """What hands do, by the names of the JSON interface; each raises `UserError` where it is refused."""
        screen, panel = self.screen, self.panel
        return {
            "press": self.operate, "release": panel.release, "turn": self._turn, "wheel": panel.wheel,
            "screen_key": screen.press, "soft_key": screen.soft, "side_key": screen.side, "type": screen.type,
            "fault": self._fault, "signal": self._signal, "display": self._display,
        }  # fmt: skip

    def press(self, *keys: str) -> None:
        """Press keys of the machine panel together."""
        self.do("press", keys=list(keys))

    def release(self, *keys: str) -> None:
        """Let keys of the machine panel go."""
        self.do("release", keys=list(keys))

    def turn(self, switch: str, position: str) -> None:
        """Turn a switch of the machine panel."""
        self.do("turn", switch=switch, position=position)

    def wheel(self, notches: int) -> None:
        """Turn the handwheel."""
        self.do("wheel", notches=notches)

    def operate(self, *keys: str) -> None:
        """Press keys of the machine panel together; cycle start in MDI runs what was typed in on the screen.

        Raises:
            CommandRefused: As `Panel.press`.
        """
        starts = _START in {key.upper() for key in keys} and self.control.state is State.READY
        if not (starts and self.screen.takes_start()):
            self.panel.press(*keys)

    def _turn(self, switch: str, position: str) -> None:
        self.panel.turn(switch, position)
        positions = self.panel.positions.items()
        self.control.panel_settings[_SWITCHES] = {name: at for name, at in positions if name != "mode"}

    def _display(self, unit: str) -> None:
        self.unit = unit

    def _fault(self, name: str, pressed: bool = True) -> None:
        inject(self.control, name, on=pressed)

    def _signal(self, name: str, value: float) -> None:
        if not name or not isinstance(value, int | float):
            raise CommandRefused("mainrun.value", name="value", allowed="0 … 1", value=value)
        self.control.signals[name] = float(value)

"""A control with its screen and its machine panel, worked by hand in one language."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.mainrun import State, VirtualControl
from polycnc.messages.catalogue import LANGUAGES
from polycnc.panel import Light
from polycnc.panel.screens.view import View, Window
from polycnc.panel.web.desk import Desk

if TYPE_CHECKING:
    from pathlib import Path


class Bench(Desk):
    """A desk that is looked at in one language: soft keys and lamps are named by what stands on them there.

    Args:
        control: Id of the control.
        lang: The language.
        program: What is loaded.
        card: The folder that is its memory card.
        more: Further arguments of the control.
    """

    def __init__(
        self, control: str, lang: str, program: str = "", *, card: Path | None = None, **more: Any
    ) -> None:
        super().__init__(VirtualControl(control, **more), card=card)
        self.lang = lang
        if program:
            self.control.load(program)

    def says(self, *texts: str) -> str:
        """One text in each language: the one of this bench."""
        return dict(zip(LANGUAGES, texts, strict=True))[self.lang]

    # ---- hands ---------------------------------------------------------------------------------------------

    def keys(self, *names: str) -> None:
        """Keys of the MDI unit, one after the other."""
        for name in names:
            self.screen.press(name)

    def soft(self, *texts: str) -> None:
        """A soft key by its text in each language; ▷ is pressed until it is there."""
        wanted, below = self.says(*texts), [""]
        for _ in range(6):
            below = [key.text for key in self.view.soft_keys]
            if wanted in below:
                self.screen.soft(below.index(wanted))
                return
            self.screen.press("MENU")
        raise AssertionError(f"no soft key {wanted}, there is {below}")

    def side(self, *texts: str) -> None:
        """A soft key at the side by its text in each language; the last one is pressed until it is there."""
        wanted, shown = self.says(*texts), [""]
        for _ in range(4):
            shown = [key.text for key in self.view.side_keys]
            if wanted in shown:
                self.screen.side(shown.index(wanted))
                return
            self.screen.side(len(shown) - 1)
        raise AssertionError(f"no soft key {wanted} at the side, there is {shown}")

    def typed(self, text: str, *keys: str) -> None:
        """Type something, then press keys of the MDI unit."""
        self.screen.type(text)
        self.keys(*keys)

    def passes(self, seconds: float) -> None:
        """Let simulated time pass, with the screen looking on."""
        self.control.step(seconds)
        self.screen.follow()

    def start(self) -> State:
        """Cycle start, until nothing moves any more."""
        self.press("START")
        return self.control.run()

    def state(self) -> State:
        """What the control is doing."""
        return self.control.state

    def sounds(self) -> bool:
        """Whether the buzzer sounds."""
        return self.panel.buzzer

    def alarms(self) -> list[str]:
        """The numbers of its alarms."""
        return [alarm.code for alarm in self.control.alarms]

    # ---- eyes ----------------------------------------------------------------------------------------------

    @property
    def view(self) -> View:
        return self.screen.view(self.lang)

    @property
    def text(self) -> str:
        return self.view.text

    @property
    def message(self) -> str:
        return self.view.message

    def window(self, kind: str) -> Window:
        """The first window of a kind."""
        return next(each for each in self.view.windows if each.kind == kind)

    def light(self, *names: str) -> Light:
        """The lamp with this name."""
        wanted = self.says(*names)
        (lamp,) = (each for each in self.panel.description.lights.values() if each.name[self.lang] == wanted)
        return self.panel.lamps()[lamp.id]

    def is_lit(self, *names: str) -> bool:
        """Whether the lamp with this name is on."""
        return self.light(*names) is Light.ON

"""Measured input B on the screen: the machine's signals open a page and a touch of the sensor writes it (III.2.1.3).

The page changes by itself, OFST or WSFT blinks. The number is that of the cursor, or by 5005#5 that of the signals OFN0
to OFN9. A touch stops the axis and locks its direction until the contact opens.
"""

from __future__ import annotations

from functools import partial

from polycnc.control.fanuc.lathe.tools.sensor import CONTACTS, OFFSETS, MeasuredInputB
from polycnc.deferred.typing import TYPE_CHECKING, Protocol
from polycnc.mainrun import Mode
from polycnc.messages import UserError

if TYPE_CHECKING:
    from collections.abc import Set as AbstractSet

    from polycnc.channel.channel import Channel
    from polycnc.mainrun import VirtualControl
    from polycnc.panel.screens.pages import Page

#: Signals that choose the number, the lowest bit first; all off is number 1.
NUMBERS = tuple(f"OFN{bit}" for bit in range(10))
SIGNALS = frozenset(("GOQSM", "WOQSM", "S2TLS", "WOSET", *CONTACTS, *NUMBERS))
#: 5005#5: the signals choose the number, not the cursor.
_BY_SIGNALS = "5005#5"
#: Pages on which is written.
_PAGES = {"GOQSM": "geometry", "WOQSM": "work-shift"}
_WORDS = {OFFSETS: {"en": "OFST", "zh-TW": "偏移"}}
_SHIFT = {"en": "WSFT", "zh-TW": "工件偏移"}


class Shown(Protocol):
    """What it asks of a screen (`state.ScreenState`)."""

    page: Page
    refusal: UserError | None

    @property
    def cursor(self) -> tuple[int, int]:
        """Row and column of the cursor."""

    def show(self, page: str) -> None:
        """Turn to a page."""

    def place(self, row: int, column: int) -> int:
        """Put the cursor somewhere."""


class Measuring:
    """The sensor of a control.

    Args:
        control: The control, a lathe.
    """

    def __init__(self, control: VirtualControl) -> None:
        self._control = control
        self._channel: Channel | None = None
        self._made: MeasuredInputB | None = None

    @property
    def _sensor(self) -> MeasuredInputB:
        """That of the present channel: with the power a new one comes."""
        channel = self._control.channel
        if self._made is None or self._channel is not channel:
            self._channel, self._made = channel, MeasuredInputB(channel)
        return self._made

    @property
    def locked(self) -> AbstractSet[tuple[str, int]]:
        """Axes with the directions in which a contact locks them."""
        return self._sensor.locked

    def status(self, lang: str) -> str:
        """What blinks in the status line; empty for nothing."""
        status = self._sensor.status
        return _WORDS.get(status, _SHIFT)[lang] if status else ""

    @property
    def leads_cursor(self) -> bool:
        """Whether signals choose the number, so that keys do not move the cursor."""
        return self._sensor.status == OFFSETS and bool(self._control.read_parameter(_BY_SIGNALS))

    def hear(self, screen: Shown, name: str, *, on: bool) -> None:
        """A signal has changed; what cannot be done is the screen's message."""
        sensor = self._sensor
        if name in NUMBERS:
            if self._control.read_parameter(_BY_SIGNALS):
                code = sum(1 << bit for bit, each in enumerate(NUMBERS) if self._control.signals[each])
                sensor.choose_by_signal(code + 1)
                self._place(screen)
            return
        if name == "GOQSM" and on and self._control.mode not in (Mode.HANDLE, Mode.JOG):
            return
        try:
            self._act(screen, sensor, name, on=on)
        except UserError as refusal:
            screen.refusal = refusal

    def _act(self, screen: Shown, sensor: MeasuredInputB, name: str, *, on: bool) -> None:
        if on and name in CONTACTS:
            if sensor.status == OFFSETS and not self.leads_cursor:
                sensor.choose(screen.cursor[0])
            self._control.stop_jog()
        touch = partial(sensor.signal, name, on=on)
        if on and (name in CONTACTS or name == "WOSET"):
            self._control.change(lambda _: touch())
        else:
            touch()
        for output, holds in sensor.outputs.items():
            self._control.signals[output] = float(holds)
        if on and name in _PAGES and sensor.status:
            screen.show(_PAGES[name])
            if self.leads_cursor:
                self._place(screen)

    def _place(self, screen: Shown) -> None:
        if screen.page.id == "geometry":
            screen.place(self._sensor.number, screen.cursor[1])

"""What a program shows on the screen beside messages: dialogs (MMC, job planning 14.7), its section (SEFORM, 2.3).

Both act when the axes are there. No dialog moves an axis; an acknowledgement that the program waits for is a stop.
"""

from __future__ import annotations

from functools import partial

from polycnc.channel.states.state import Lifetime, State
from polycnc.control.sinumerik.errors import not_supported
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Deed

if TYPE_CHECKING:
    from collections.abc import Callable

    from polycnc.channel.channel import Channel
    from polycnc.control.sinumerik.family import SinumerikChannel

#: The stop of a program that waits for the operator's OK.
STOP = "MMC"
#: The operating area of dialogs of the user, and what it is told.
_AREA, _ON, _OFF = "CYCLES", "PICTURE_ON", "PICTURE_OFF"
#: Ways to acknowledge: the program waits for OK; OK sets a variable; there is nothing to acknowledge.
SYNCHRONOUS, ASYNCHRONOUS, NONE = "S", "A", "N"
#: Places of the words behind PICTURE_ON.
_FILE, _PICTURE, _DEFINITIONS, _GRAPHIC, _TIME, _TEXTS = range(2, 8)


@dataclass(frozen=True, slots=True)
class Dialog:
    """A dialog that a program shows.

    Attributes:
        file: The COM file that describes it; `picture` is its name there.
        definitions: The file that defines the user variables it reads and writes.
        graphic: A graphics file.
        time: Seconds that it is shown, or the variable that OK sets; empty for neither.
        texts: Variables whose texts stand in it.
        acknowledged: How it is acknowledged.
    """

    file: str
    picture: str
    definitions: str = ""
    graphic: str = ""
    time: str = ""
    texts: tuple[str, ...] = ()
    acknowledged: str = NONE

    @property
    def seconds(self) -> float | None:
        """How long it is shown; None for until it is taken away."""
        try:
            return float(self.time)
        except ValueError:
            return None


@dataclass(slots=True)
class OperatorScreen(State, lifetime=Lifetime.RESET):
    """What the screen shows of the program.

    Attributes:
        dialog: The dialog; None for none.
        section: Name of the section that runs.
    """

    dialog: Dialog | None = None
    section: str = ""


def shown(channel: Channel) -> Dialog | None:
    """The dialog that a program of a channel shows."""
    return OperatorScreen.of(channel).dialog


def section(channel: Channel) -> str:
    """The section that the program of a channel runs; empty for none."""
    return OperatorScreen.of(channel).section


def show(channel: Channel, dialog: Dialog | None) -> None:
    """A dialog is shown from here on; None for none any more."""
    OperatorScreen.of(channel).dialog = dialog


def call(channel: SinumerikChannel, args: tuple[object, ...]) -> None:
    """MMC("CYCLES,PICTURE_ON,file,picture,…", mode) shows a dialog, PICTURE_OFF takes it away.

    Without anybody who executes the program in time it is acknowledged at once.
    """
    words = str(args[0]).split(",") if args and isinstance(args[0], str) else []
    mode = str(args[1]).upper() if len(args) > 1 and args[1] is not None else NONE
    words = [word.strip() for word in words]
    area, command = (word.upper() for word in (*words, "", "")[:2])
    if len(args) > 2 or mode not in (SYNCHRONOUS, ASYNCHRONOUS, NONE) or not area:
        raise AlarmError("14020", text="MMC")
    if area != _AREA:
        raise not_supported(f"MMC {area}")
    if command == _OFF:
        _when_there(channel, "MMC", partial(show, channel, None))
        return
    if command != _ON or len(words) <= _PICTURE or not words[_FILE] or not words[_PICTURE]:
        raise AlarmError("14020", text="MMC")
    words += [""] * (_TEXTS - len(words))
    texts = tuple(word for word in words[_TEXTS:] if word)
    dialog = Dialog(
        words[_FILE], words[_PICTURE], words[_DEFINITIONS], words[_GRAPHIC], words[_TIME], texts, mode
    )
    _when_there(channel, "MMC", partial(show, channel, dialog))
    if mode == SYNCHRONOUS:
        channel.stop(STOP)


def begin_section(channel: SinumerikChannel, name: str) -> None:
    """A section begins (SEFORM)."""
    _when_there(channel, "SEFORM", partial(_name_section, channel, name))


def _name_section(channel: SinumerikChannel, name: str) -> None:
    OperatorScreen.of(channel).section = name


def _when_there(channel: SinumerikChannel, what: str, do: Callable[[], None]) -> None:
    """Something that the screen shows happens when the axes are there; at once where nobody executes them."""
    if channel.main_run is None:
        do()
    else:
        channel.event(Deed(what, None, do))

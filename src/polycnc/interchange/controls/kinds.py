"""What a control writes of its memory."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from polycnc.deferred.modules import import_module
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping

    from polycnc.channel.channel import Channel

#: From a channel at power-on to the text of a file.
Writer: TypeAlias = Callable[[Any], str]
#: Takes a text over, (channel, content), and says what it has left out; None where the text has another form.
Reader: TypeAlias = "Callable[[Channel, str], list[str] | None]"

PROGRAMS, SETUP = "programs", "setup"
#: Programs as one file, or each as its own.
TAPE, ARCHIVE, FILES = "tape", "archive", "files"


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of data: the name of its file, and what writes it."""

    file: str
    write: Writer


@dataclass(frozen=True, slots=True)
class Texts:
    """The texts of a control.

    Attributes:
        kinds: Kinds of data by name, in the order in which a memory takes them.
        programs: How programs are written: `TAPE`, `ARCHIVE`, `FILES`.
        program_file: The file of all programs.
        readers: Forms that are no programs, each asked in turn; what none of them knows is run as a program.
    """

    kinds: Mapping[str, Kind]
    programs: str
    program_file: str = ""
    readers: tuple[Reader, ...] = ()


_MODULES = {
    "fanuc-m": ("mills", "FANUC"),
    "meldas-m": ("mills", "MELDAS"),
    "fanuc-0i-tf": ("lathe", "TEXTS"),
    "syntec-mill": ("syntec", "TEXTS"),
    "sinumerik-840d": ("sinumerik", "TEXTS"),
}


@cache
def texts_of(control: str) -> Texts:
    """The texts of a control."""
    module, name = _MODULES[control]
    found: Texts = getattr(import_module(f"polycnc.interchange.controls.{module}"), name)
    return found

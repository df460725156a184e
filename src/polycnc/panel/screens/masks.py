"""Input masks of SINUMERIK from text files: calls of user cycles (cov.com, uc.com), dialogs of programs (COM files).

    //C25 (MY_CYCLE_1) usercycle_1
    (R/-1000.001 123.456 / 100 /Parameter_2 of cycle)
    (I/*123456/3/Machining type)

Job planning 1.25.4. Behind the label a field may name a variable of the user, which it then shows and writes.
"""

from __future__ import annotations

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.mainrun import CommandRefused
from polycnc.panel.keyed import number_of, whole_number_of

if TYPE_CHECKING:
    from collections.abc import Iterable

#: Characters of a label that a screen shows.
LONGEST_LABEL = 50
REAL, WHOLE, CHARACTER, STRING = "R", "I", "C", "S"
_HEAD = regex(r"\s*//\s*[A-Z]?(\d*)\s*\(\s*([^)]*?)\s*\)\s*(.*)")
_LISTED = regex(r"\s*C(\d+)\s*\(\s*([^)]*?)\s*\)\s*(.*)")
_FIELD = regex(r"\s*\(\s*([RICS])\s*/(.*)\)\s*(?:;.*)?")
_LIMITS = regex(r"\s*(\S+)\s+(\S+)\s*")


@dataclass(frozen=True, slots=True)
class MaskField:
    """A field of a mask.

    Attributes:
        kind: `R` a real number, `I` a whole one, `C` a character, `S` a string.
        label: What stands beside it.
        preset: What it has at first.
        limits: Lowest and highest value; None for none.
        choices: The values that the toggle key offers; empty for any.
        variable: The variable that it shows and writes; empty for none.
    """

    kind: str
    label: str
    preset: str = ""
    limits: tuple[float, float] | None = None
    choices: tuple[str, ...] = ()
    variable: str = ""

    def accepted(self, typed: str) -> str:
        """A value as the field keeps it.

        Raises:
            CommandRefused: The field does not take it.
        """
        typed = typed.strip()
        if self.kind == CHARACTER and len(typed) > 1:
            raise CommandRefused("screen.value", value=typed)
        if self.kind in (CHARACTER, STRING) or not typed:
            return typed
        value = number_of(typed) if self.kind == REAL else whole_number_of(typed)
        beyond = self.limits is not None and not self.limits[0] <= value <= self.limits[1]
        if beyond or (self.choices and typed not in self.choices):
            raise CommandRefused("screen.value", value=typed)
        return f"{value:.10g}" if self.kind == REAL else str(value)

    def argument(self, value: str) -> str:
        """A value as a call writes it."""
        return f'"{value}"' if value and self.kind in (CHARACTER, STRING) else value


@dataclass(frozen=True, slots=True)
class Mask:
    """A mask: its number and name in the file, a comment, its fields."""

    number: str
    name: str
    comment: str
    fields: tuple[MaskField, ...] = ()


@dataclass(slots=True)
class MaskInput:
    """A mask that is filled in.

    Attributes:
        mask: The mask.
        values: What each field has.
    """

    mask: Mask
    values: list[str] = field(default_factory=list)

    def enter(self, row: int, typed: str) -> MaskField:
        """Put a value into a field, if that takes it; gives the field."""
        which = self._field(row)
        self.values[row] = which.accepted(typed)
        return which

    def toggle(self, row: int) -> MaskField:
        """The next of the values that a field offers; gives the field."""
        which = self._field(row)
        if not which.choices:
            raise CommandRefused("screen.no-field")
        now = self.values[row]
        place = which.choices.index(now) + 1 if now in which.choices else 0
        self.values[row] = which.choices[place % len(which.choices)]
        return which

    def _field(self, row: int) -> MaskField:
        if not 0 <= row < len(self.mask.fields):
            raise CommandRefused("screen.no-field")
        return self.mask.fields[row]

    @property
    def call(self) -> str:
        """The block that calls the cycle."""
        pairs = zip(self.mask.fields, self.values, strict=True)
        arguments = ",".join(each.argument(value) for each, value in pairs)
        return f"{self.mask.name.replace(' ', '')}({arguments.rstrip(',')})"


def filled(mask: Mask) -> MaskInput:
    """A mask with what its fields have at first."""
    return MaskInput(mask, [each.preset for each in mask.fields])


def masks_of(lines: Iterable[str]) -> list[Mask]:
    """The masks of a file, in order."""
    found: list[Mask] = []
    for line in lines:
        if head := _HEAD.fullmatch(line.rstrip()):
            found.append(Mask(head[1], head[2], head[3].strip()))
        elif found and (row := _FIELD.fullmatch(line.rstrip())):
            last = found[-1]
            found[-1] = Mask(last.number, last.name, last.comment, (*last.fields, _field_of(row[1], row[2])))
    return found


def overview_of(lines: Iterable[str]) -> list[Mask]:
    """The cycles that cov.com lists, in order."""
    return [
        Mask(row[1], row[2], row[3].strip()) for line in lines if (row := _LISTED.fullmatch(line.rstrip()))
    ]


def _field_of(kind: str, text: str) -> MaskField:
    """A field from what stands behind its type: `limits/preset/label[/variable]`, where limits may be left out."""
    parts = [part.strip() for part in text.split("/")]
    has_limits = kind in (REAL, WHOLE) and (parts[0].startswith("*") or bool(_LIMITS.fullmatch(parts[0])))
    if len(parts) == 2:
        parts = [parts[0], "", parts[1]] if has_limits else ["", *parts]
    parts += [""] * (4 - len(parts))
    limits: tuple[float, float] | None = None
    choices: tuple[str, ...] = ()
    if has_limits and parts[0].startswith("*"):
        choices = tuple(each for each in parts[0][1:] if not each.isspace())
    elif has_limits and (pair := _LIMITS.fullmatch(parts[0])):
        limits = _pair(pair[1], pair[2])
    preset = parts[1].strip('"')
    return MaskField(kind, parts[2][:LONGEST_LABEL], preset, limits, choices, parts[3])


def _pair(low: str, high: str) -> tuple[float, float] | None:
    try:
        return float(low), float(high)
    except ValueError:
        return None

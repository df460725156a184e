"""YAML and TOML documents as values; YAML is read strictly, so that nothing is taken for what its writer did not mean.

Refused are keys that stand twice, numbers that YAML 1.1 and 1.2 read differently (`010`, `1:30`, `1_000`), tags, and
documents that are deeper, longer or, by aliases, larger than any setup. The words on, off, yes and no are true and
false as values; as keys they are words. Case files have their own `Dialect`, in which they are words everywhere and
`033` is a code.
"""

from __future__ import annotations

import re

from polycnc.deferred.records import dataclass
from polycnc.deferred.regexes import regex
from polycnc.deferred.toml import plain
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.machine.places import toml_error_place, yaml_loader

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    import yaml

#: No setup is deeper; none has more values, those that aliases bring in again included.
MOST_DEPTH, MOST_VALUES = 40, 1_000_000
#: A number with more digits is none that any control has.
MOST_DIGITS = 40
_WHOLE = regex(r"[-+]?(?:0|[1-9]\d*)", re.ASCII)
_HEXADECIMAL = regex(r"0x[0-9a-fA-F]+")
_DECIMAL = regex(r"[-+]?(?:\.\d+|\d+\.\d*|\d+(?=[eE]))(?:[eE][-+]?\d+)?", re.ASCII)
_NOT_FINITE = regex(r"[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN)")
#: Octal, sexagesimal, grouped and binary numbers of YAML 1.1 or 1.2.
_DOUBTFUL = regex(
    r"[-+]?(?:0[\d_]+|0o[0-7]+|0b[01_]+|\d[\d_]*_[\d_]*(?:\.[\d_]*)?|[1-9][\d_]*(?::[0-5]?\d)+(?:\.[\d_]*)?)",
    re.ASCII,
)
_WORDS: dict[str, bool | None] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL"), None),
    **{each: True for word in ("true", "yes", "on") for each in (word, word.title(), word.upper())},
    **{each: False for word in ("false", "no", "off") for each in (word, word.title(), word.upper())},
}
#: The words of YAML 1.2 alone.
_CORE_WORDS = {
    word: value for word, value in _WORDS.items() if word.lower() not in {"yes", "on", "no", "off"}
}
_TEXT_TAGS = ("tag:yaml.org,2002:str", "!")
_MERGE = "<<"


class DocumentError(Exception):
    """What is wrong with a document.

    Attributes:
        line: From 1; 0 where the whole document is meant.
        column: From 1, or 0.
        message: Id of the text in the catalogue of this folder.
        args_by_name: Values for its placeholders.
    """

    def __init__(self, line: int, column: int, message: str, **args: object) -> None:
        super().__init__(message)
        self.line = line
        self.column = column
        self.message = message
        self.args_by_name = args


@dataclass(frozen=True, slots=True)
class Dialect:
    """How plain words are read.

    Attributes:
        words: Those that are no texts.
        doubts: Whether a number that versions of YAML read differently is refused; else it is a text.
    """

    words: Mapping[str, bool | None]
    doubts: bool


SETUP = Dialect(_WORDS, doubts=True)
CASES = Dialect(_CORE_WORDS, doubts=False)


@dataclass(frozen=True, slots=True)
class _Read:
    """A value, and how many values it is with all that aliases bring in."""

    value: Any
    size: int


def yaml_values(text: str, dialect: Dialect = SETUP) -> object:
    """The values of a YAML text: dicts, lists, numbers, texts, true and false, None.

    Raises:
        DocumentError: It is no YAML, or something in it is refused.
    """
    import yaml

    try:
        return _Reader(yaml.parse(text, Loader=yaml_loader()), dialect).document()
    except yaml.YAMLError as error:
        mark = getattr(error, "problem_mark", None)
        place = (mark.line + 1, mark.column + 1) if mark else (0, 0)
        detail = getattr(error, "problem", None) or " ".join(str(error).split())
        if (
            "maximum nesting depth" in detail
        ):  # libyaml's own limit; its scanner may be far ahead of what is read
            raise DocumentError(place[0], place[1], "too-deep") from None
        raise DocumentError(place[0], place[1], "not-yaml", detail=detail) from None


def toml_values(text: str) -> dict[str, object]:
    """The values of a TOML text.

    Raises:
        DocumentError: It is no TOML, or more than can be read.
    """
    found = plain(text)
    if found is not None:
        return found
    import tomllib

    try:
        return tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        detail, (line, column) = toml_error_place(str(error), text)
        raise DocumentError(line, column, "not-toml", detail=detail) from error
    except RecursionError:
        raise DocumentError(0, 0, "too-deep") from None
    except ValueError:  # of `int`, which takes so many digits and no more
        raise DocumentError(0, 0, "too-many-digits") from None


class _Reader:
    """Makes values of the events of a parser."""

    def __init__(self, events: Iterator[yaml.Event], dialect: Dialect) -> None:
        self._dialect = dialect
        self._events: Iterator[Any] = iter(events)
        self._anchors: dict[str, _Read | None] = {}
        self._depth = 0

    def document(self) -> object:
        """The only document of the stream; None where there is none."""
        import yaml

        next(self._events)
        event = next(self._events)
        if isinstance(event, yaml.StreamEndEvent):
            return None
        found = self._read(next(self._events)).value
        next(self._events)
        event = next(self._events)
        if not isinstance(event, yaml.StreamEndEvent):
            raise _refused(event, "second-document")
        return found

    def _read(self, event: Any) -> _Read:
        import yaml

        if isinstance(event, yaml.AliasEvent):
            return self._alias(event)
        anchor = event.anchor
        if anchor is not None:
            self._anchors[anchor] = None
        if isinstance(event, yaml.ScalarEvent):
            found = _Read(_scalar(event, self._dialect), 1)
        else:
            self._depth += 1
            if self._depth > MOST_DEPTH:
                raise _refused(event, "too-deep")
            if not event.implicit:
                raise _refused(event, "tag", tag=event.tag)
            is_list = isinstance(event, yaml.SequenceStartEvent)
            found = self._list() if is_list else self._table()
            self._depth -= 1
        if found.size > MOST_VALUES:
            raise _refused(event, "too-large")
        if anchor is not None:
            self._anchors[anchor] = found
        return found

    def _alias(self, event: Any) -> _Read:
        found = self._anchors.get(event.anchor)
        if found is None:
            raise _refused(event, "no-anchor", name=event.anchor)
        return found

    def _list(self) -> _Read:
        import yaml

        values, size = [], 1
        while not isinstance(event := next(self._events), yaml.SequenceEndEvent):
            element = self._read(event)
            values.append(element.value)
            size += element.size
        return _Read(values, size)

    def _table(self) -> _Read:
        import yaml

        table: dict[object, object] = {}
        merged: dict[object, object] = {}
        seen: set[str] = set()
        size = 1
        while not isinstance(event := next(self._events), yaml.MappingEndEvent):
            if not isinstance(event, yaml.ScalarEvent):
                raise _refused(event, "key-no-word")
            key = _key(event, self._dialect)
            if str(key) in seen:
                raise _refused(event, "key-twice", name=key)
            seen.add(str(key))
            at = next(self._events)
            element = self._read(at)
            size += element.size
            if size > MOST_VALUES:
                raise _refused(event, "too-large")
            if key == _MERGE and event.implicit[0]:
                merged = _joined(element.value, at)
            else:
                table[key] = element.value
        own = {str(key) for key in table}
        return _Read({key: value for key, value in merged.items() if str(key) not in own} | table, size)


def _joined(value: object, event: Any) -> dict[object, object]:
    """The tables that `<<` names as one; what stands first wins."""
    found: dict[object, object] = {}
    for table in value if isinstance(value, list) else [value]:
        if not isinstance(table, dict):
            raise _refused(event, "merge")
        found = table | found
    return found


def _key(event: Any, dialect: Dialect) -> int | str:
    """A key: whole numbers as such, all else as its text."""
    text = str(event.value)
    if not event.implicit[0]:
        return text
    if dialect.doubts and _DOUBTFUL.fullmatch(text):
        raise _refused(event, "doubtful-number", value=text[:MOST_DIGITS])
    return int(text) if _WHOLE.fullmatch(text) and len(text) <= MOST_DIGITS else text


def _scalar(event: Any, dialect: Dialect) -> object:
    text = str(event.value)
    if not event.implicit[0]:
        if event.implicit[1] or event.tag in _TEXT_TAGS:
            return text
        raise _refused(event, "tag", tag=event.tag)
    if text in dialect.words:
        return dialect.words[text]
    if dialect.doubts and _DOUBTFUL.fullmatch(text):
        raise _refused(event, "doubtful-number", value=text[:MOST_DIGITS])
    if _WHOLE.fullmatch(text) or _HEXADECIMAL.fullmatch(text):
        if len(text) > MOST_DIGITS:
            raise _refused(event, "too-many-digits")
        return int(text, 0)
    if _DECIMAL.fullmatch(text) or _NOT_FINITE.fullmatch(text):
        return float(text.replace(".", "", 1) if _NOT_FINITE.fullmatch(text) else text)
    return text


def _refused(event: Any, message: str, **args: object) -> DocumentError:
    mark = event.start_mark
    return DocumentError(mark.line + 1, mark.column + 1, message, **args)

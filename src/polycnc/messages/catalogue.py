"""Text catalogues: TOML tables `[id]` with `en` and `zh-TW`, each read when its text is wanted."""

from __future__ import annotations

import os
import re
from collections import ChainMap
from collections.abc import Mapping
from functools import cache, cached_property

from polycnc.deferred.paths import package_path, read_text
from polycnc.deferred.regexes import regex
from polycnc.deferred.toml import loads
from polycnc.deferred.typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from pathlib import Path

LANGUAGES = ("en", "zh-TW")
_active = "en"
#: The heading of a table.
_HEADING = regex(r'^\[(?:"([^"\n]+)"|([\w-]+))\]$', re.MULTILINE)


def language() -> str:
    """The language of texts that are asked for without one."""
    return _active


def set_language(lang: str) -> None:
    """Choose the language of all texts; raises `ValueError` for one that polycnc does not speak."""
    global _active  # noqa: PLW0603 - one process speaks one language
    if lang not in LANGUAGES:
        raise ValueError(lang)
    _active = lang


def language_of_environment() -> str:
    """The language that the user's locale asks for; English where it asks for neither."""
    locale = os.environ.get("POLYCNC_LANG") or os.environ.get("LC_ALL") or os.environ.get("LANG") or ""
    return "zh-TW" if locale.replace("_", "-").startswith(("zh-TW", "zh-Hant", "zh-HK")) else "en"


class Catalogue:
    """One table of texts. Missing ids are a mistake in polycnc, never in a program: they raise `KeyError`.

    Args:
        sources: TOML files; of an id in several of them the last one counts.
        entries: Texts that lie over those of the files.
    """

    def __init__(self, *sources: str | Path, entries: Mapping[str, dict[str, str]] | None = None) -> None:
        self._sources = sources
        self._over = dict(entries or {})

    def extended(
        self, *sources: str | Path, entries: Mapping[str, dict[str, str]] | None = None
    ) -> Catalogue:
        """This catalogue with further texts laid over it."""
        return Catalogue(*self._sources, *sources, entries={**self._over, **(entries or {})})

    @cached_property
    def _entries(self) -> Mapping[str, dict[str, str]]:
        return ChainMap(self._over, *map(_file, reversed(self._sources)))  # type: ignore[arg-type]  # none is changed

    def __contains__(self, key: str) -> bool:
        return key in self._entries

    def __iter__(self) -> Iterator[str]:
        return iter(self._entries)

    def entry(self, key: str) -> dict[str, str]:
        """All fields of one text: `en`, `zh-TW` and, for alarms, `cause`/`remedy` in both languages."""
        return self._entries[key]

    def note(
        self,
        key: str,
        kind: Literal["cause", "remedy"],
        lang: str | None = None,
        args: Mapping[str, object] | None = None,
    ) -> str:
        """Why an alarm comes, or what to do about it; empty where the catalogue does not tell."""
        lang = lang or _active
        return fill(self._entries[key].get(kind if lang == "en" else f"{kind}-{lang}", ""), args or {})

    def text(self, key: str, lang: str | None = None, **args: object) -> str:
        """The text of `key` with its placeholders filled; `…` stands for a value that is not given."""
        return fill(self._entries[key][lang or _active], args)


class _File(Mapping[str, dict[str, str]]):
    """The texts of a file by their ids. Of some hundred tables a run wants few, so each is read for itself.

    Args:
        content: The file. Tables have their headings on lines of their own, and no other line begins with a bracket;
            what stands above the first heading is read at once.
    """

    def __init__(self, content: str) -> None:
        self._content = f"\n{content}\n"
        self._read: dict[str, dict[str, str]] = loads(self._content[: self._end_of(0)])
        self._above = tuple(self._read)

    def _end_of(self, start: int) -> int:
        """Where the table ends that `start` lies in."""
        end = self._content.find("\n[", start)
        return len(self._content) if end < 0 else end

    def __getitem__(self, key: str) -> dict[str, str]:
        if key not in self._read:
            start = self._place_of(key)
            self._read |= loads(self._content[start : self._end_of(start + 1)])
        return self._read[key]

    def _place_of(self, key: str) -> int:
        for heading in (f'\n["{key}"]\n', f"\n[{key}]\n"):
            if (start := self._content.find(heading)) >= 0:
                return start
        raise KeyError(key)

    @cached_property
    def _ids(self) -> dict[str, None]:
        return dict.fromkeys(
            (*self._above, *(one or other for one, other in _HEADING.findall(self._content)))
        )

    def __iter__(self) -> Iterator[str]:
        return iter(self._ids)

    def __len__(self) -> int:
        return len(self._ids)


@cache
def _file(path: str | Path) -> _File:
    return _File(read_text(path))


def listed(words: Iterable[str]) -> str:
    """Words one after the other, as the active language separates them."""
    return (", " if _active == "en" else "、").join(words)


#: `<at {text}|here>`: the first form where its values are given, the second where one is missing or empty.
_CHOICE = regex(r"<([^<>|]*\{[^<>|]*)\|([^<>|]*)>")
_PLACEHOLDER = regex(r"\{(\w+)")


class _Missing(dict[str, object]):
    def __missing__(self, key: str) -> str:
        return "…"


def fill(template: str, args: Mapping[str, object]) -> str:
    """Fill the `{name}` placeholders of a text, and choose the form of `<with {name}|without>`."""

    def chosen(found: re.Match[str]) -> str:
        return (
            found[1] if all(args.get(name) not in {None, ""} for name in placeholders(found[1])) else found[2]
        )

    if "<" in template:
        template = _CHOICE.sub(chosen, template)
    return template.format_map(_Missing(args))


def placeholders(template: str, *, needed: bool = False) -> set[str]:
    """The names of values that a text can show; only those that it cannot do without where `needed`."""
    return set(_PLACEHOLDER.findall(_CHOICE.sub("", template) if needed else template))


@cache
def messages() -> Catalogue:
    """The texts of polycnc itself."""
    return Catalogue(package_path("messages", "messages.toml"))


def text(key: str, lang: str | None = None, **args: object) -> str:
    """A text of polycnc itself (command line, reports, hints)."""
    return messages().text(key, lang, **args)

"""Text catalogues: TOML tables `[id]` with `en` and `zh-TW`, read when the first text is wanted."""

from __future__ import annotations

import os
import re
import tomllib
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from importlib.resources.abc import Traversable

LANGUAGES = ("en", "zh-TW")
_active = "en"
#: The texts of files that have been read, by their names.
_READ: dict[str, Mapping[str, dict[str, str]]] = {}


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

    def __init__(self, *sources: Traversable, entries: Mapping[str, dict[str, str]] | None = None) -> None:
        self._sources = sources
        self._over = entries or {}
        self._entries: dict[str, dict[str, str]] | None = None

    def extended(
        self, *sources: Traversable, entries: Mapping[str, dict[str, str]] | None = None
    ) -> Catalogue:
        """This catalogue with further texts laid over it."""
        return Catalogue(*self._sources, *sources, entries={**self._over, **(entries or {})})

    def _load(self) -> dict[str, dict[str, str]]:
        if self._entries is None:
            self._entries = {}
            for source in self._sources:
                self._entries |= _texts(source)
            self._entries |= self._over
        return self._entries

    def __contains__(self, key: str) -> bool:
        return key in self._load()

    def __iter__(self) -> Iterator[str]:
        return iter(self._load())

    def entry(self, key: str) -> dict[str, str]:
        """All fields of one text: `en`, `zh-TW` and, for alarms, `cause`/`remedy` in both languages."""
        return self._load()[key]

    def note(
        self,
        key: str,
        kind: Literal["cause", "remedy"],
        lang: str | None = None,
        args: Mapping[str, object] | None = None,
    ) -> str:
        """Why an alarm comes, or what to do about it; empty where the catalogue does not tell."""
        lang = lang or _active
        return fill(self._load()[key].get(kind if lang == "en" else f"{kind}-{lang}", ""), args or {})

    def text(self, key: str, lang: str | None = None, **args: object) -> str:
        """The text of `key` with its placeholders filled; `…` stands for a value that is not given."""
        return fill(self._load()[key][lang or _active], args)


def _texts(source: Traversable) -> Mapping[str, dict[str, str]]:
    """The texts of a file of polycnc, read once."""
    name = str(source)
    if name not in _READ:
        _READ[name] = tomllib.loads(source.read_text(encoding="utf-8"))
    return _READ[name]


def listed(words: Iterable[str]) -> str:
    """Words one after the other, as the active language separates them."""
    return (", " if _active == "en" else "、").join(words)


#: `<at {text}|here>`: the first form where its values are given, the second where one is missing or empty.
_CHOICE = re.compile(r"<([^<>|]*\{[^<>|]*)\|([^<>|]*)>")
_PLACEHOLDER = re.compile(r"\{(\w+)")


class _Missing(dict[str, object]):
    def __missing__(self, key: str) -> str:
        return "…"


def fill(template: str, args: Mapping[str, object]) -> str:
    """Fill the `{name}` placeholders of a text, and choose the form of `<with {name}|without>`."""

    def chosen(found: re.Match[str]) -> str:
        return (
            found[1] if all(args.get(name) not in {None, ""} for name in placeholders(found[1])) else found[2]
        )

    return _CHOICE.sub(chosen, template).format_map(_Missing(args))


def placeholders(template: str, *, needed: bool = False) -> set[str]:
    """The names of values that a text can show; only those that it cannot do without where `needed`."""
    return set(_PLACEHOLDER.findall(_CHOICE.sub("", template) if needed else template))


@cache
def messages() -> Catalogue:
    """The texts of polycnc itself."""
    return Catalogue(resources.files("polycnc.messages").joinpath("messages.toml"))


def text(key: str, lang: str | None = None, **args: object) -> str:
    """A text of polycnc itself (command line, reports, hints)."""
    return messages().text(key, lang, **args)

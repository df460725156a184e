"""Text catalogues: TOML tables `[id]` with `en` and `zh-TW`, read when the first text is wanted."""

from __future__ import annotations

import os
import tomllib
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Literal

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from importlib.resources.abc import Traversable

LANGUAGES = ("en", "zh-TW")
_active = "en"


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
    """

    def __init__(self, *sources: Traversable) -> None:
        self._sources = sources
        self._entries: dict[str, dict[str, str]] | None = None

    def _load(self) -> dict[str, dict[str, str]]:
        if self._entries is None:
            self._entries = {}
            for source in self._sources:
                self._entries |= tomllib.loads(source.read_text(encoding="utf-8"))
        return self._entries

    def __contains__(self, key: str) -> bool:
        return key in self._load()

    def __iter__(self) -> Iterator[str]:
        return iter(self._load())

    def entry(self, key: str) -> dict[str, str]:
        """All fields of one text: `en`, `zh-TW` and, for alarms, `cause`/`remedy` in both languages."""
        return self._load()[key]

    def note(self, key: str, kind: Literal["cause", "remedy"], lang: str | None = None) -> str:
        """Why an alarm comes, or what to do about it; empty where the catalogue does not tell."""
        lang = lang or _active
        return self._load()[key].get(kind if lang == "en" else f"{kind}-{lang}", "")

    def text(self, key: str, lang: str | None = None, **args: object) -> str:
        """The text of `key` with its placeholders filled; a placeholder without a value is shown as it stands."""
        return fill(self._load()[key][lang or _active], args)


def listed(words: Iterable[str]) -> str:
    """Words one after the other, as the active language separates them."""
    return (", " if _active == "en" else "、").join(words)


class _KeepMissing(dict[str, object]):
    def __missing__(self, key: str) -> str:
        return "{" + key + "}"


def fill(template: str, args: dict[str, object]) -> str:
    """Fill the `{name}` placeholders of a text."""
    return template.format_map(_KeepMissing(args))


@cache
def messages() -> Catalogue:
    """The texts of polycnc itself."""
    return Catalogue(resources.files("polycnc.messages").joinpath("messages.toml"))


def text(key: str, lang: str | None = None, **args: object) -> str:
    """A text of polycnc itself (command line, reports, hints)."""
    return messages().text(key, lang, **args)

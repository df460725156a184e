"""The language of the command line itself: Click knows its pages of help and its refusals in English only."""

from __future__ import annotations

import re
from functools import cache

from polycnc.deferred.paths import package_path, read_text
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.messages.catalogue import LANGUAGES, language, language_of_environment

if TYPE_CHECKING:
    from collections.abc import Sequence

#: Options that show the page of help and leave.
HELP = ("-h", "--help")


def language_of(words: Sequence[str]) -> str:
    """The language must be known before the first help text is looked up, so `--lang` is read here."""
    for word, following in zip(words, [*words[1:], ""], strict=False):
        chosen = following if word == "--lang" else word.removeprefix("--lang=") if "=" in word else ""
        if word.startswith("--lang") and chosen in LANGUAGES:
            return chosen
    return language_of_environment()


def translated(told: str) -> str:
    """What Click says, in the active language; what the table does not know stays as it is."""
    if language() != "en":
        for pattern, phrase in _phrases(language()):
            told = pattern.sub(phrase, told)
    return told


@cache
def _phrases(lang: str) -> tuple[tuple[re.Pattern[str], str], ...]:
    import tomllib

    table: dict[str, list[dict[str, str]]] = tomllib.loads(read_text(package_path("cli", "usage.toml")))
    return tuple((re.compile(row["pattern"], re.MULTILINE), row[lang]) for row in table["phrase"])

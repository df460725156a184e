"""A text that the user reads, as a machine file gives it."""

from __future__ import annotations

from polycnc.deferred.records import dataclass
from polycnc.messages.catalogue import language


@dataclass(frozen=True, slots=True)
class Text:
    """A text that the user reads; `zh_tw` is empty where the author wrote one language only."""

    en: str = ""
    zh_tw: str = ""

    def __str__(self) -> str:
        return self.zh_tw if self.zh_tw and language() == "zh-TW" else self.en


NO_TEXT = Text()

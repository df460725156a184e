"""Which cases are run: by words of the id, and by feature."""

from __future__ import annotations

from polycnc.deferred.records import dataclass


@dataclass(frozen=True, slots=True)
class Selection:
    """A case is run if its id holds `words`, and its feature is one of `only` (if any) and none of `skip`."""

    words: str = ""
    only: frozenset[str] = frozenset()
    skip: frozenset[str] = frozenset()

    def names(self, case_id: str) -> bool:
        """Whether a case of this id belongs to the run at all."""
        return self.words.casefold() in case_id.casefold()

    def features(self, feature: str) -> bool:
        """Whether a case of this feature is run, or counted as skipped."""
        return (not self.only or feature in self.only) and feature not in self.skip

"""Which features work, told by cases: a feature works on a control if all of its cases there pass."""

from __future__ import annotations

import json
from functools import cache
from importlib import resources
from typing import TYPE_CHECKING, Any

from polycnc.cases.reading import read_cases
from polycnc.cases.runner import run_cases
from polycnc.cases.selection import Selection
from polycnc.messages import Catalogue

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping
    from pathlib import Path

    from polycnc.cases.runner import Outcome

#: Control id to feature id to number of cases.
Features = dict[str, dict[str, int]]


def shipped() -> Features:
    """The features of this version of polycnc, as its own cases showed when it was made."""
    source = resources.files("polycnc").joinpath("data", "features.json")
    features: Features = json.loads(source.read_text(encoding="utf-8"))
    return features


@cache
def functions() -> Catalogue:
    """Names of all features in both languages, in the order of the manuals, with the `codes` that meet them."""
    folder = resources.files("polycnc").joinpath("data", "functions")
    return Catalogue(*sorted(folder.iterdir(), key=lambda source: source.name))


def in_manual_order(counts: Mapping[str, int]) -> list[str]:
    """The ids of features as their manuals have them; those without a name, of other people's cases, come last."""
    place = {feature: number for number, feature in enumerate(functions())}
    return sorted(counts, key=lambda feature: (place.get(feature, len(place)), feature))


def case_files(folder: Path) -> list[Path]:
    """The case files of a folder and of those in it, in order of their names."""
    return sorted(folder.rglob("*.yaml"))


def proved(folder: Path) -> Features:
    """Run all cases of a folder and give the features that work.

    Raises:
        UnreadableError: A case file cannot be read.
    """
    return counted(_outcomes(folder))


def counted(outcomes: Iterable[Outcome]) -> Features:
    """The features all of whose cases passed, sorted, with the number of their cases."""
    found: dict[tuple[str, str], list[bool]] = {}
    for outcome in outcomes:
        if outcome.feature:
            found.setdefault((outcome.control, outcome.feature), []).append(outcome.status == "passed")
    features: Features = {}
    for (control, feature), passed in sorted(found.items()):
        if all(passed):
            features.setdefault(control, {})[feature] = len(passed)
    return features


def claimed(cases: Iterable[Mapping[str, Any]]) -> Features:
    """The features that cases speak of, whether they pass or not."""
    features: Features = {}
    for case in cases:
        if case.get("feature"):
            counts = features.setdefault(str(case.get("control")), {})
            counts[str(case["feature"])] = counts.get(str(case["feature"]), 0) + 1
    return {control: dict(sorted(features[control].items())) for control in sorted(features)}


def _outcomes(folder: Path) -> Iterator[Outcome]:
    for path in case_files(folder):
        yield from run_cases(read_cases(path), Selection(), path.parent)

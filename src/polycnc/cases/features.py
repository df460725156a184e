"""Which features work: one works on a control if all cases of it pass there, and all tests that name it.

Cases tell what programs do. Screens and operator panels have tests instead, which name their features with a marker
(`@pytest.mark.feature`); the report that pytest writes (`--junitxml`) says which of them passed.
"""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from xml.etree import ElementTree

from polycnc.cases.reading import UnreadableError, read_cases
from polycnc.cases.runner import run_cases
from polycnc.cases.selection import Selection
from polycnc.deferred.paths import package_path
from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.messages import Catalogue
from polycnc.messages.files import reason_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator, Mapping

    from polycnc.cases.runner import Outcome

    Counted = Callable[[Iterable[Path]], Iterable[Path]]

#: Control id to feature id to number of cases.
Features = dict[str, dict[str, int]]

_DATA = Path(package_path("data"))
#: What a test says of itself in the report: its property of this name is `<control> <feature>`.
PROPERTY = "feature"
#: Elements of the report below a test that did not pass.
_NOT_PASSED = ("failure", "error", "skipped")


def shipped() -> Features:
    """The features of this version of polycnc, as its own cases and tests showed when it was made."""
    features: Features = {}
    for each in (shipped_of_cases(), shipped_of_tests()):
        for control, counts in each.items():
            known = features.setdefault(control, {})
            for feature, count in counts.items():
                known[feature] = known.get(feature, 0) + count
    return {control: dict(sorted(features[control].items())) for control in sorted(features)}


def shipped_of_cases() -> Features:
    """The part of them that cases showed."""
    return _list("features.json")


def shipped_of_tests() -> Features:
    """The part of them that tests of screens and panels showed."""
    return _list("tested.json")


def _list(name: str) -> Features:
    features: Features = json.loads((_DATA / name).read_text(encoding="utf-8"))
    return features


@cache
def functions() -> Catalogue:
    """Names of all features in both languages, in the order of the manuals, with the `codes` that meet them."""
    return Catalogue(*sorted((_DATA / "functions").iterdir()))


def in_manual_order(counts: Mapping[str, int]) -> list[str]:
    """The ids of features as their manuals have them; those without a name, of other people's cases, come last."""
    place = {feature: number for number, feature in enumerate(functions())}
    return sorted(counts, key=lambda feature: (place.get(feature, len(place)), feature))


def case_files(folder: Path) -> list[Path]:
    """The case files of a folder and of those in it, in order of their names."""
    return sorted(folder.rglob("*.yaml"))


def proved(folder: Path | None, report: Path | None = None, each: Counted = iter) -> Features:
    """Run all cases of a folder, read the report of the tests, and give the features that work.

    Args:
        folder: With files of cases.
        report: What pytest wrote.
        each: Gives the files of cases on, where somebody counts them.

    Raises:
        UnreadableError: A case file or the report cannot be read.
    """
    outcomes = () if folder is None else _outcomes(each(case_files(folder)))
    return counted(outcomes, () if report is None else tested(report))


def tested(report: Path) -> Iterator[tuple[str, str, bool]]:
    """Control, feature, and whether the test passed, of every test that names a feature in a report of pytest.

    Raises:
        UnreadableError: The file is no such report.
    """
    try:
        suites = ElementTree.fromstring(report.read_bytes())
    except OSError as error:
        raise UnreadableError("file.unreadable", file=report, reason=reason_of(error)) from None
    except ElementTree.ParseError:
        raise UnreadableError("case.no-report", file=report) from None
    for test in suites.iter("testcase"):
        passed = all(test.find(name) is None for name in _NOT_PASSED)
        for each in test.iter("property"):
            if each.get("name") == PROPERTY:
                control, feature = each.get("value", "").split()
                yield control, feature, passed


def counted(outcomes: Iterable[Outcome], tests: Iterable[tuple[str, str, bool]] = ()) -> Features:
    """The features all of whose cases and tests passed, sorted, with their number."""
    found: dict[tuple[str, str], list[bool]] = {}
    for outcome in outcomes:
        if outcome.feature:
            found.setdefault((outcome.control, outcome.feature), []).append(outcome.status == "passed")
    for control, feature, test_passed in tests:
        found.setdefault((control, feature), []).append(test_passed)
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


def _outcomes(files: Iterable[Path]) -> Iterator[Outcome]:
    for path in files:
        yield from run_cases(read_cases(path), Selection(), path.parent)

"""The limit for expressions that no type checker checks."""

import pytest

from tests.any_exprs import complaint, modules, share

REPORT = """\
                  Name   Anys    Exprs   Coverage
-------------------------------------------------
               polycnc      0       10    100.00%
   polycnc.machine.plc      1      140     99.29%
      polycnc.toolpath      2       50     96.00%
tests.machine.test_plc     90      100     10.00%
-------------------------------------------------
                 Total     93      300     69.00%
"""


def test_only_modules_of_the_package_count() -> None:
    assert share(modules(REPORT)) == pytest.approx(1.5)
    assert complaint(modules(REPORT), 1.5) == ""


def test_too_many_are_told_with_the_worst_modules_first() -> None:
    *_, worst, next_, last = complaint(modules(REPORT), 1.4).splitlines()
    assert worst.split() == ["2", "of", "50", "polycnc.toolpath"]
    assert next_.endswith("polycnc.machine.plc")
    assert last.endswith("polycnc")

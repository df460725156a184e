"""`polycnc run --sample` and `polycnc plot --profile`."""

from __future__ import annotations

import csv
import io
import sys
from typing import TYPE_CHECKING
from xml.etree import ElementTree

import pytest

from polycnc.cli.commands.run import period_s
from tests.cli.console import GOOD

if TYPE_CHECKING:
    from tests.cli.console import Console

FANUC = ("--control", "fanuc-m")


@pytest.mark.parametrize(
    ("written", "seconds"), [("1ms", 1e-3), ("0.5s", 0.5), ("250 us", 2.5e-4), (".1", 0.1)]
)
def test_a_period_has_a_unit(written: str, seconds: float) -> None:
    assert period_s(written) == pytest.approx(seconds)


@pytest.mark.parametrize("written", ["", "ms", "-1ms", "0", "1min", "1e-3"])
def test_what_is_no_period_is_refused(written: str, console: Console) -> None:
    assert period_s(written) is None
    console.file("good.nc", GOOD)
    said = console("run", "good.nc", *FANUC, f"--sample={written}", "out.csv")
    assert said.status == 2
    assert not (console.folder / "out.csv").exists()


def test_samples_are_csv_by_the_suffix(console: Console) -> None:
    console.file("good.nc", GOOD)
    said = console("run", "good.nc", *FANUC, "--sample", "10ms", "out.csv")
    assert said.status == 0
    rows = list(csv.DictReader(io.StringIO((console.folder / "out.csv").read_text(encoding="utf-8"))))
    assert float(rows[1]["time"]) == pytest.approx(0.01)
    assert {"x_position", "z_acceleration", "spindle_rpm", "spindle_angle", "line"} <= set(rows[0])
    assert rows[-1]["program"] == "O0001"


def test_samples_are_parquet_by_the_suffix(console: Console) -> None:
    parquet = pytest.importorskip("pyarrow.parquet")
    console.file("good.nc", GOOD)
    assert console("run", "good.nc", *FANUC, "--sample", "2ms", "out.parquet").status == 0
    table = parquet.read_table(console.folder / "out.parquet")
    assert table["time"][1].as_py() == pytest.approx(0.002)
    assert table.schema.metadata[b"machine"] == b"mill3"
    assert str(table.schema.field("program").type) == "dictionary<values=string, indices=int32, ordered=0>"
    assert str(table.schema.field("line").type) == "int32"
    console("run", "good.nc", *FANUC, "--sample", "2ms", "out.csv")
    rows = csv.DictReader(io.StringIO((console.folder / "out.csv").read_text(encoding="utf-8")))
    assert [{name: str(value) for name, value in row.items()} for row in table.to_pylist()] == list(rows)


def test_samples_need_numpy_alone(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("pyarrow", "pyarrow.parquet"):
        monkeypatch.setitem(sys.modules, name, None)
    console.file("good.nc", GOOD)
    assert console("run", "good.nc", *FANUC, "--sample", "2ms", "out.parquet").status == 0
    assert (console.folder / "out.parquet").read_bytes()[-4:] == b"PAR1"
    monkeypatch.setattr("polycnc.cli.commands.run.is_installed", lambda name: name != "numpy")
    said = console("run", "good.nc", *FANUC, "--sample", "2ms", "out.csv")
    assert (said.status, "needs NumPy: pip install" in said.err) == (2, True)


def test_a_profile_is_a_drawing(console: Console) -> None:
    console.file("good.nc", GOOD)
    assert console("plot", "good.nc", *FANUC, "--profile", "-o", "profile.svg").status == 0
    drawing = ElementTree.fromstring((console.folder / "profile.svg").read_text(encoding="utf-8"))
    words = " ".join(drawing.itertext())
    assert "acceleration" in words
    assert "time (s)" in words

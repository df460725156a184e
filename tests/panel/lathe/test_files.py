"""READ, PUNCH and ALL IO of the lathe (0i-TF Plus III.1.1, III.1.2)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from tests.panel.bench import Bench

    Make = Callable[..., Bench]

OPRT = ("(OPRT)", "(操作)")
READ, PUNCH = ("READ", "讀入"), ("PUNCH", "輸出")
EXEC, CANCEL = ("EXEC", "執行"), ("CAN", "取消")
Y_PAGE, SECOND = ("OFST.2", "刀偏.2"), ("2ND GEOM", "第2形狀")
#: The page, the file's own name, the block of number 3 with 1.5 on the page.
PAGES = [
    pytest.param(
        *(Y_PAGE, "TOOLOFST.TXT", "G10 P03 Y1.500 ;"),
        id="y",
        marks=pytest.mark.feature("fan.io_y_offset", control="fanuc-0i-tf"),
    ),
    pytest.param(
        *(SECOND, "SEC_GEOM.TXT", "G10 P20003 X1.500 Z0.000 Y0.000 ;"),
        id="second",
        marks=pytest.mark.feature("fan.io_second_geom", control="fanuc-0i-tf"),
    ),
]


def opened(panel: Bench, page: tuple[str, str]) -> Bench:
    panel.screen.buffer = ""
    panel.keys("OFS/SET")
    panel.soft(*page)
    panel.soft(*OPRT)
    return panel


def ready(bench: Make, folder: Path, page: tuple[str, str]) -> Bench:
    """A bench in EDIT mode with 1.5 in number 3 of a page."""
    panel = opened(bench(card=folder, setup={"parameters": {"3290#5": 1}}), page)
    panel.typed("3")
    panel.soft("NO.SRH", "NO.SRH")
    panel.typed("1.5", "INPUT")
    assert panel.message == ""
    panel.turn("mode", "edit")
    return panel


def blinks(panel: Bench) -> str:
    """What blinks in the status line."""
    return " ".join(cell.text for cell in panel.view.status if cell.style == "blink")


@pytest.mark.parametrize(("page", "file", "block"), PAGES)
def test_what_is_punched_is_read_again(
    page: tuple[str, str], file: str, block: str, bench: Make, tmp_path: Path
) -> None:
    panel = ready(bench, tmp_path, page)
    panel.soft(*PUNCH)
    assert blinks(panel) == ""
    panel.soft(*EXEC)
    assert blinks(panel) == "OUTPUT"
    assert not list(tmp_path.iterdir())
    panel.passes(5.0)
    assert blinks(panel) == ""
    assert panel.message == ""
    written = (tmp_path / file).read_text()
    assert written.startswith("%\n")
    assert written.endswith("%\n")
    assert block in written.splitlines()
    (tmp_path / "OWN.TXT").write_text(written.replace("1.500", "-4.250"))
    opened(panel, page)
    panel.soft(*READ)
    panel.typed("OWN.TXT")
    panel.soft(*EXEC)
    assert blinks(panel) == "INPUT"
    assert "-4.250" not in panel.window("table").text
    panel.passes(5.0)
    assert blinks(panel) == ""
    assert "-4.250" in panel.window("table").text
    panel.soft(*READ)
    panel.soft(*EXEC)
    panel.passes(5.0)
    assert "1.500" in panel.window("table").text, "without a name it is the file's own"


@pytest.mark.parametrize(("page", "file", "block"), PAGES)
def test_a_transfer_that_is_given_up_changes_nothing(
    page: tuple[str, str], file: str, block: str, bench: Make, tmp_path: Path
) -> None:
    panel = ready(bench, tmp_path, page)
    (tmp_path / file).write_text(f"%\n{block.replace('1.500', '9.000')}\n%\n" + "\n" * 4000)
    panel.soft(*READ)
    panel.soft(*EXEC)
    panel.passes(0.2)
    assert blinks(panel) == "INPUT"
    panel.soft(*CANCEL)
    assert blinks(panel) == ""
    panel.passes(5.0)
    assert "1.500" in panel.window("table").text
    panel.soft(*PUNCH)
    panel.typed("NEW.TXT")
    panel.soft(*EXEC)
    panel.soft(*CANCEL)
    panel.passes(5.0)
    assert not (tmp_path / "NEW.TXT").exists()


@pytest.mark.parametrize(("page", "file", "block"), PAGES)
def test_what_cannot_be_read_is_told_and_changes_nothing(
    page: tuple[str, str], file: str, block: str, bench: Make, tmp_path: Path
) -> None:
    panel = ready(bench, tmp_path, page)
    panel.soft(*READ)
    panel.soft(*EXEC)
    assert panel.message == panel.says(
        f"the card has no file {file} that can be read or written", f"記憶卡上沒有可讀寫的檔案 {file}"
    )
    panel.typed("../OUTSIDE.TXT")
    panel.soft(*EXEC)
    assert "OUTSIDE" in panel.message
    panel.soft(*CANCEL)
    panel.screen.buffer = ""
    (tmp_path / file).write_text(f"%\n{block.replace('1.500', '9.000')}\nG10 P03 Q_\n%\n")
    panel.soft(*READ)
    panel.soft(*EXEC)
    panel.passes(1.0)
    assert panel.message
    assert "1.500" in panel.window("table").text
    panel.turn("mode", "mdi")
    panel.soft(*READ)
    assert panel.message == panel.says("this is done in mode EDIT", "此操作須在 EDIT 模式進行")


KINDS = [
    (("Y OFST", "Y 偏移"), ("ALL IO / Y OFFSET", "所有 IO / Y 偏移"), "TOOLOFST.TXT", Y_PAGE, "P03 Y"),
    (("GEOM 2", "形狀 2"), ("ALL IO / 2ND GEOMETRY", "所有 IO / 第 2 形狀"), "SEC_GEOM.TXT", SECOND, "P20003 X"),
]  # fmt: skip


@pytest.mark.feature("fan.io_all_io", control="fanuc-0i-tf")
@pytest.mark.parametrize(("key", "title", "file", "page", "words"), KINDS, ids=["y", "second"])
def test_all_io_punches_and_reads_by_name(
    key: tuple[str, str],
    title: tuple[str, str],
    file: str,
    page: tuple[str, str],
    words: str,
    bench: Make,
    tmp_path: Path,
) -> None:
    panel = ready(bench, tmp_path, page)
    panel.keys("SYSTEM")
    panel.soft("ALL IO", "所有 IO")
    panel.soft(*key)
    assert panel.view.title == panel.says(*title)
    panel.soft(*OPRT)
    panel.soft(*PUNCH)
    panel.soft(*EXEC)
    panel.passes(5.0)
    assert file in panel.window("card").text
    assert f"{words}1.500" in (tmp_path / file).read_text()
    (tmp_path / "NEXT.TXT").write_text((tmp_path / file).read_text().replace("1.500", "2.750"))
    panel.soft("N INPUT", "N 輸入")
    panel.typed("NEXT.TXT")
    panel.soft("F NAME", "F 名稱")
    assert panel.view.buffer == ""
    panel.soft(*EXEC)
    assert blinks(panel) == "INPUT"
    panel.soft(*CANCEL)
    panel.passes(5.0)
    panel.soft("N INPUT", "N 輸入")
    panel.typed("NEXT.TXT")
    panel.soft("F NAME", "F 名稱")
    panel.soft(*EXEC)
    panel.passes(5.0)
    assert blinks(panel) == ""
    assert panel.message == ""
    opened(panel, page)
    assert "2.750" in panel.window("table").text


@pytest.mark.feature("fan.io_all_io", control="fanuc-0i-tf")
def test_all_io_wants_edit_mode_and_a_card(bench: Make, tmp_path: Path) -> None:
    panel = bench()
    panel.keys("SYSTEM")
    panel.soft("ALL IO", "所有 IO")
    panel.soft("Y OFST", "Y 偏移")
    panel.soft(*OPRT)
    panel.soft("N INPUT", "N 輸入")
    assert panel.message == panel.says("this is done in mode EDIT", "此操作須在 EDIT 模式進行")
    panel.turn("mode", "edit")
    panel.soft("N INPUT", "N 輸入")
    panel.soft(*EXEC)
    assert panel.message == panel.says("there is no memory card", "沒有記憶卡")


@pytest.mark.feature("fan.io_all_io", control="fanuc-0i-tf")
def test_programs_and_other_offsets_go_through_all_io_too(bench: Make, tmp_path: Path) -> None:
    panel = bench("O0007\nG0 X1.\nM30\n", card=tmp_path)
    panel.turn("mode", "edit")
    for key, file in (
        (("PRGRM", "程式"), "O0007"),
        (("OFFSET", "補正"), "TOOLOFST.TXT"),
        (("WORK", "座標系"), "EXT_WKZ.TXT"),
        (("W.SHFT", "工件偏移"), "WORKSHFT.TXT"),
    ):
        panel.keys("SYSTEM")
        panel.soft("ALL IO", "所有 IO")
        panel.soft(*key)
        panel.soft(*OPRT)
        panel.soft(*PUNCH)
        panel.soft(*EXEC)
        panel.passes(20.0)
        assert (tmp_path / file).read_text().startswith("%\n"), panel.message


def test_a_machine_without_a_y_axis_punches_no_offsets_of_it(bench: Make, tmp_path: Path) -> None:
    panel = opened(bench(card=tmp_path, machine="lathe-c"), Y_PAGE)
    panel.turn("mode", "edit")
    panel.soft(*PUNCH)
    panel.soft(*EXEC)
    panel.passes(5.0)
    assert panel.message
    assert not list(tmp_path.iterdir())

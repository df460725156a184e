from __future__ import annotations

from pathlib import Path

import polycnc


def test_definition_files_are_read_by_kind_and_owner(tmp_path: Path) -> None:
    folder = tmp_path / "DEF.DIR"
    folder.mkdir()
    steps = ["OWN", "PMAC", "SGUD", "MGUD", "SPARE", "UGUD", "GUD4", "GUD9", "UACCESS"]
    for name in steps:
        is_macro = name in ("OWN", "PMAC")
        text = f"DEFINE AS_{name} AS 0\nM30\n" if is_macro else f"DEF NCK INT OF_{name}\nM30\n"
        (folder / f"{name}.DEF").write_text(text)
    main = tmp_path / "MAIN.MPF"
    main.write_text("R1=AS_OWN\nM30\n")
    result = polycnc.run(main, control="sinumerik-840d")
    assert not result.alarms
    defined = [name for name in result.channel.memory.language.global_variables if name.startswith("OF_")]
    assert defined == [f"OF_{name}" for name in ("SGUD", "MGUD", "UGUD", "GUD4", "GUD9", "SPARE", "UACCESS")]


def test_an_alarm_in_a_definition_file_names_its_file_line_and_column(tmp_path: Path) -> None:
    folder = tmp_path / "DEF.DIR"
    folder.mkdir()
    (folder / "MGUD.DEF").write_text("DEF NCK INT GOOD\nDEF NCK INT BAD[70000]\nM30\n")
    main = tmp_path / "MAIN.MPF"
    main.write_text("M30\n")
    (alarm,) = polycnc.run(main, control="sinumerik-840d").alarms
    assert (Path(alarm.file).name, alarm.line, alarm.column) == ("MGUD.DEF", 2, 17)

"""Letters that are engraved: which there are, and that their marks keep off them."""

from __future__ import annotations

from polycnc.cycles.milling.letters import drawn

UMLAUTS_AND_ACCENTS = "ÄÖÜäöüÀÁÂÃÅÈÉÊËÌÍÎÏÑÒÓÔÕÙÚÛÝàáâãåèéêëìíîïñòóôõùúûýÿŠšŽž"


def test_every_printed_character_of_ascii_is_drawn() -> None:
    assert all(drawn(chr(code)) is not None for code in range(0x20, 0x7F))


def test_a_mark_lies_over_its_letter() -> None:
    for letter in UMLAUTS_AND_ACCENTS:
        lines = drawn(letter)
        assert lines is not None, letter
        body = [point for line in lines for point in line if point[1] <= (4 if letter.islower() else 6)]
        mark = [point for line in lines for point in line if point not in body]
        assert mark, letter
        assert min(y for _, y in mark) > max(y for _, y in body)


def test_a_letter_of_another_script_is_not_drawn() -> None:
    assert drawn("字") is None
    assert drawn("Й") is None

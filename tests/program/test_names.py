from __future__ import annotations

import pytest

from polycnc.program.names import (
    bare_name,
    default_directory,
    program_name,
    split_stored_path,
    stored_directory,
    stored_name,
)


@pytest.mark.parametrize("name", ["sub1.spf", "SUB1_SPF", "_N_SUB1_SPF", "_n_Sub1_spf", " SUB1.SPF "])
def test_all_spellings_have_one_stored_name(name: str) -> None:
    assert stored_name(name) == "_N_SUB1_SPF"


@pytest.mark.parametrize("path", ["WKS.DIR/TEST.WPD", "/_N_WKS_DIR/_N_TEST_WPD/", "\\wks.dir\\test.wpd"])
def test_all_spellings_have_one_stored_directory(path: str) -> None:
    assert stored_directory(path) == "/_N_WKS_DIR/_N_TEST_WPD"


@pytest.mark.parametrize("name", ["_N_SUB1_SPF", "_N_SUB1_MPF", "_n_sub1_spf", "SUB1"])
def test_a_call_without_type_finds_all_types_of_a_name(name: str) -> None:
    assert bare_name(name) == "SUB1"


def test_a_bare_name_has_no_directory() -> None:
    assert split_stored_path("SUB1") == ("", "_N_SUB1")
    assert split_stored_path("/_N_CST_DIR/_N_CYCLE1_SPF") == ("/_N_CST_DIR", "_N_CYCLE1_SPF")


@pytest.mark.parametrize(
    ("name", "directory"),
    [
        ("_N_A_SPF", "/_N_SPF_DIR"),
        ("_N_A_INI", "/_N_RAM"),
        ("_N_A_MPF", "/_N_MPF_DIR"),
        ("_N_A_COM", "/_N_MPF_DIR"),
    ],
)
def test_a_unit_without_path_goes_where_its_type_belongs(name: str, directory: str) -> None:
    assert default_directory(name) == directory


def test_a_program_number_has_at_least_four_digits() -> None:
    assert [program_name(7), program_name(12345678)] == ["O0007", "O12345678"]

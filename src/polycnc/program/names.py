"""Names of programs and directories as SINUMERIK stores them: `_N_SUB1_SPF` in `/_N_WKS_DIR/_N_TEST_WPD`.

Upper and lower case are the same to the control. A PC writes `SUB1.SPF` and `TEST.WPD` for the same things;
both spellings have one stored name, so comparing stored names is all that a search must do (job planning 1.25
and 2.1).
"""

from __future__ import annotations

from polycnc.deferred.regexes import regex
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable

MPF_DIR = "/_N_MPF_DIR"
SPF_DIR = "/_N_SPF_DIR"
DEF_DIR = "/_N_DEF_DIR"
CYCLE_DIRS = ("/_N_CUS_DIR", "/_N_CMA_DIR", "/_N_CST_DIR")
"""Cycles of the user, of the machine's manufacturer and of the control, in the order of the search."""

WORKING_MEMORY = "/_N_RAM"
"""Where an archive puts initialisation files that name no directory."""

WORKPIECE = "_WPD"
"""Type of the directory of a workpiece."""

#: Characters of a name of a program or file (job planning, glossary), and of its type: `_SPF`.
LONGEST_NAME, TYPE_LENGTH = 24, 4
#: Stored names that only definition files have: macros, user data and rights of Siemens, builder and user.
_DEFINITION_FILE = regex(r"_N_(?:[A-Z](?:MAC|GUD|ACCESS)|GUD[4-9])_DEF")

STANDARD_DIRS = (MPF_DIR, SPF_DIR, DEF_DIR, *CYCLE_DIRS, "/_N_WKS_DIR", "/_N_COM_DIR")


def stored_name(name: str) -> str:
    """`sub1.spf`, `SUB1_SPF` and `_N_SUB1_SPF` are `_N_SUB1_SPF`; a name without type stays without."""
    name = name.strip().upper()
    if not name.startswith("_N_"):
        name = "_N_" + name
    return name.replace(".", "_")


def is_definition_file(name: str) -> bool:
    """Whether a stored name is one that the control reserves for definition files (`_N_MGUD_DEF`)."""
    return _DEFINITION_FILE.fullmatch(name) is not None


def bare_name(name: str) -> str:
    """`_N_SUB1_SPF` is `SUB1`: as a call names it that does not say the type."""
    return name.upper().removeprefix("_N_").removesuffix("_SPF").removesuffix("_MPF")


def is_too_long(name: str) -> bool:
    """Whether a stored name is longer than the control allows: 24 characters beside `_N_` and the type."""
    bare = name.removeprefix("_N_")
    has_type = len(bare) > TYPE_LENGTH and bare[-TYPE_LENGTH] == "_"
    return len(bare) - (TYPE_LENGTH if has_type else 0) > LONGEST_NAME


def stored_directory(directory: str) -> str:
    """`WKS.DIR/TEST.WPD`, `/_n_wks_dir/_n_test_wpd/` are `/_N_WKS_DIR/_N_TEST_WPD`; nothing stays nothing."""
    parts = [part for part in directory.replace("\\", "/").split("/") if part.strip()]
    return "".join("/" + stored_name(part) for part in parts)


def split_stored_path(path: str) -> tuple[str, str]:
    """Directory and name of `/_N_WKS_DIR/_N_TEST_WPD/_N_SUB1_SPF`; the directory of a bare name is empty."""
    directory, _, name = path.replace("\\", "/").rpartition("/")
    return stored_directory(directory), stored_name(name)


def default_directory(name: str) -> str:
    """Where a file of an archive goes that names no directory (job planning 2.1)."""
    if name.endswith("_SPF"):
        return SPF_DIR
    return WORKING_MEMORY if name.endswith("_INI") else MPF_DIR


def main_of_workpiece(directory: str, stored_names: Iterable[str]) -> str | None:
    """The main program that selecting a workpiece directory selects: of the same name, or the only one (2.1)."""
    mains = [name for name in stored_names if name.endswith("_MPF")]
    same = directory.rpartition("/")[2].removesuffix(WORKPIECE) + "_MPF"
    if same in mains:
        return same
    return mains[0] if len(mains) == 1 else None


def program_name(number: int) -> str:
    """A program number as word-address controls show it: at least four digits."""
    return f"O{number:04d}"

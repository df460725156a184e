"""What the README shows is what polycnc says."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from polycnc.cli import main
from polycnc.messages.catalogue import set_language

if TYPE_CHECKING:
    from _pytest.capture import CaptureFixture

ROOT = Path(__file__).parents[1]


def test_the_readme_shows_what_its_command_prints(
    capsys: CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(ROOT)
    monkeypatch.setenv("NO_COLOR", "1")
    monkeypatch.setenv("POLYCNC_LANG", "en")
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    command = readme.partition("What `polycnc ")[2].partition("`")[0]
    with pytest.raises(SystemExit) as left:
        main(command.split())
    set_language("en")
    assert left.value.code == 0
    printed = capsys.readouterr().out
    assert f"```\n{printed}```" in readme

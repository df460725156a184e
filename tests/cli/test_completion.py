"""The shell completes words: its script is shown and installed, and asks polycnc."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest

from polycnc.cli.completion import SHELLS

if TYPE_CHECKING:
    from tests.cli.console import Console


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A home folder; a folder with `polycnc` in the path of programs."""
    folder = tmp_path / "programs"
    folder.mkdir()
    program(folder / "polycnc", f'exec "{sys.executable}" -m polycnc "$@"')
    monkeypatch.setenv("PATH", str(folder), prepend=os.pathsep)
    home = tmp_path / "home"
    home.mkdir()
    monkeypatch.setattr(Path, "home", lambda: home)
    monkeypatch.setenv("HOME", str(home))
    return home


def program(path: Path, line: str) -> None:
    path.write_text(f"#!/bin/sh\n{line}\n", encoding="utf-8")
    path.chmod(0o755)


def offered(shell: str, words: str, begun: str) -> list[str]:
    """What polycnc answers the script of a shell that asks how a line goes on."""
    line = f"polycnc {words} {begun}"
    count = begun if shell == "fish" else str(len(line.split()) - bool(begun))
    environment = {"_POLYCNC_COMPLETE": f"{shell}_complete", "COMP_WORDS": line, "COMP_CWORD": count}
    done = subprocess.run(
        [sys.executable, "-m", "polycnc"], env={**os.environ, **environment, "POLYCNC_LANG": "en"},
        capture_output=True, text=True, timeout=120, check=True,
    )  # fmt: skip
    assert done.stderr == ""
    return done.stdout.splitlines()


@pytest.mark.parametrize(
    ("words", "begun", "answer"),
    [
        ("", "ma", ["plain,machines"]),
        ("machines", "s", ["plain,show"]),
        ("machines show", "lathe2-", ["plain,lathe2-2path"]),
        ("run --control", "s", ["plain,syntec-mill", "plain,sinumerik-840d"]),
        ("run --machine", "lathe2-", ["plain,lathe2-2path"]),
        ("run --machine", "./m", ["file,./m"]),
        ("check --format", "j", ["plain,json", "plain,junit"]),
        ("check", "--format=j", ["plain,json", "plain,junit"]),
        ("run x.nc", "--no", ["plain,--no-time", "plain,--no-bulk"]),
        ("run", "p", ["file,p"]),
        ("run x.nc --setup", "s", ["file,s"]),
        ("run x.nc --sample 1ms", "o", ["file,o"]),
        ("--show-completion", "f", ["plain,fish"]),
    ],
)
def test_a_shell_is_offered_commands_options_values_and_files(
    words: str, begun: str, answer: list[str]
) -> None:
    assert offered("bash", words, begun) == answer


@pytest.mark.parametrize(
    ("shell", "answer"),
    [
        ("zsh", ["plain", "fanuc-m", "_"]),
        ("fish", ["plain,fanuc-m"]),
        ("powershell", ["plain", "fanuc-m", "_"]),
    ],
)
def test_every_shell_is_answered_in_its_form(shell: str, answer: list[str]) -> None:
    assert offered(shell, "run --control", "fanuc-m") == answer


@pytest.mark.parametrize(
    ("shell", "answer"),
    [
        ("bash", ["plain,fanuc-m"]),
        ("zsh", ["plain", "--control=fanuc-m", "_"]),
        ("fish", ["plain,--control=fanuc-m"]),
        ("powershell", ["plain", "--control=fanuc-m", "_"]),
    ],
)
def test_a_value_behind_its_option_is_offered_as_the_shell_takes_words(shell: str, answer: list[str]) -> None:
    assert offered(shell, "run", "--control=fanuc-m") == answer


@pytest.mark.parametrize("shell", SHELLS)
def test_the_script_of_a_named_shell_is_shown(console: Console, shell: str) -> None:
    said = console("--show-completion", shell)
    assert said.status == 0
    assert said.err == ""
    assert f"{SHELLS[shell]}_complete" in said.out


def test_the_shell_that_calls_is_known(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("fish", "/usr/bin/fish"))
    assert console("--show-completion").out == console("--show-completion", "fish").out


def test_an_unknown_shell_is_told(console: Console, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("shellingham.detect_shell", lambda: ("tcsh", "/bin/tcsh"))
    said = console("--install-completion")
    assert said.status == 2
    assert said.err.startswith("polycnc: completion is there for bash, zsh, fish, powershell, pwsh, not for")
    assert console("--install-completion", "tcsh").status == 2


def bash(code: str, folder: Path) -> list[str]:
    command = ["bash", "--norc", "-c", code]
    return subprocess.run(
        command, cwd=folder, capture_output=True, text=True, timeout=120, check=True
    ).stdout.split()


@pytest.mark.skipif(sys.platform == "win32", reason="has no bash")
def test_bash_completes_when_it_is_installed(console: Console, home: Path) -> None:
    (home / ".bashrc").write_text("alias x=y", encoding="utf-8")
    for _ in range(2):
        said = console("--install-completion", "bash")
        assert said.status == 0
        assert str(home / ".bash_completions/polycnc.sh") in said.out
    startup = (home / ".bashrc").read_text(encoding="utf-8")
    assert startup == "alias x=y\nsource ~/.bash_completions/polycnc.sh\n"
    asked = "COMP_WORDS=(polycnc run --control s); COMP_CWORD=3; _polycnc_completion polycnc; echo ${COMPREPLY[@]}"
    assert bash(f"source ~/.bashrc; {asked}", home) == ["syntec-mill", "sinumerik-840d"]


#: What is typed, and what it becomes with the Tab key.
TYPED = {
    "polycnc ru": "polycnc run",
    "polycnc run --con": "polycnc run --control",
    "polycnc run --control fan": "polycnc run --control fanuc-",
    "polycnc run --control=syn": "polycnc run --control=syntec-mill",
    "polycnc run bra": "polycnc run bracket.nc",
    "polycnc run bracket.nc --setup=bra": "polycnc run bracket.nc --setup=bracket.nc",
    "polycnc check --format s": "polycnc check --format sarif",
}


@pytest.mark.skipif(shutil.which("fish") is None, reason="fish is not installed")
@pytest.mark.parametrize("typed", TYPED)
def test_fish_completes_when_it_is_installed(console: Console, home: Path, typed: str) -> None:
    assert console("--install-completion", "fish").status == 0
    (home / "bracket.nc").touch()
    command = ["fish", "--command", f"complete --do-complete '{typed}'"]
    done = subprocess.run(command, cwd=home, capture_output=True, text=True, timeout=120, check=True)
    offered = [line.partition("\t")[0] for line in done.stdout.splitlines()]
    assert common(offered) == TYPED[typed].split()[-1]


def common(words: list[str]) -> str:
    """What all words begin with."""
    return next(
        (words[0][:n] for n in range(len(words[0]), 0, -1) if all(w.startswith(words[0][:n]) for w in words)),
        "",
    )


@pytest.mark.skipif(shutil.which("zsh") is None, reason="zsh is not installed")
@pytest.mark.parametrize("typed", TYPED)
def test_zsh_completes_when_it_is_installed(console: Console, home: Path, typed: str) -> None:
    assert console("--install-completion", "zsh").status == 0
    (home / "bracket.nc").touch()
    assert typed_in_zsh(typed, home).rstrip() == TYPED[typed]


def typed_in_zsh(line: str, home: Path) -> str:
    """What a line becomes in a zsh with the Tab key: a pseudo terminal within is typed at, and the line shown then."""
    code = f"""
        zmodload zsh/zpty
        zpty inner zsh -f -i
        zpty -w inner "PS1= ; stty cols 200; source ~/.zshrc"
        zpty -w inner 'show() {{ print -r -- "[[$BUFFER]]" }}; zle -N show; bindkey "^X" show; print rea""dy'
        zpty -r inner said '*ready*'
        zpty -w -n inner $'{line}\\t\\x18'
        zpty -r inner said '*\\[\\[*\\]\\]*'
        print -r -- $said
    """
    done = subprocess.run(
        ["zsh", "-f", "-c", code], cwd=home, capture_output=True, text=True, timeout=120, check=True,
        env={**os.environ, "TERM": "dumb"},
    )  # fmt: skip
    return done.stdout.rpartition("[[")[2].partition("]]")[0]


def test_zsh_and_fish_find_their_scripts(console: Console, home: Path) -> None:
    for shell, place in ("zsh", ".zfunc/_polycnc"), ("fish", ".config/fish/completions/polycnc.fish"):
        assert console("--install-completion", shell).status == 0
        assert (home / place).read_text(encoding="utf-8") == console("--show-completion", shell).out
    assert (home / ".zshrc").read_text(encoding="utf-8").startswith("fpath+=~/.zfunc")


@pytest.mark.skipif(sys.platform == "win32", reason="has no program of a shell script")
def test_a_powershell_loads_the_script_by_its_profile(console: Console, home: Path) -> None:
    profile = home / "PowerShell" / "profile.ps1"
    program(home.parent / "programs" / "pwsh", f'echo "{profile}"')
    assert console("--install-completion", "pwsh").status == 0
    script = home / "PowerShell" / "polycnc-completion.ps1"
    assert profile.read_text(encoding="utf-8") == f". '{script}'\n"
    assert "Register-ArgumentCompleter" in script.read_text(encoding="utf-8")


def test_a_startup_file_stays_as_it_is_to_the_byte(console: Console, home: Path) -> None:
    startup = home / ".bashrc"
    startup.write_bytes(b"alias x=y\r\nalias p='\x0c'\r\n")
    assert console("--install-completion", "bash").status == 0
    assert startup.read_bytes() == (b"alias x=y\r\nalias p='\x0c'\r\nsource ~/.bash_completions/polycnc.sh\n")
    startup.write_bytes(b"alias x='\xff'\n")
    said = console("--install-completion", "bash")
    assert said.status == 2
    assert "source ~/.bash_completions/polycnc.sh" in said.err
    assert startup.read_bytes() == b"alias x='\xff'\n"

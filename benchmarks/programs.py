"""Programs for whole processes: the same work for polycnc and for LinuxCNC's rs274."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field, replace

HEAD = ["G21 G17 G90 G94", "G54 G0 X0 Y0 Z10.", "M3 S8000", "G1 Z-1. F1000."]
FOOT = ["M5", "M30"]
_HOLES = [f"X{i % 100}. Y{i // 100}." for i in range(10_000)]


@dataclass(frozen=True)
class Work:
    """A program for both, and how much faster polycnc shall be.

    Attributes:
        name: What is done.
        ours: Blocks for FANUC, with the program head.
        peer: Blocks for rs274.
        goals: For each list of options how many times as fast as the peer; the options of `polycnc run`.
        setup: Setup file.
        others: Blocks for other controls, which run without cycle time and shall reach the first goal as well.
    """

    name: str
    ours: list[str]
    peer: list[str]
    goals: dict[tuple[str, ...], float]
    setup: str = ""
    others: dict[str, list[str]] = field(default_factory=dict)


def both(name: str, blocks: list[str], goals: dict[tuple[str, ...], float]) -> Work:
    """Work whose blocks are the same for both."""
    return Work(name, [*HEAD, *blocks, *FOOT], [*HEAD, *blocks, *FOOT], goals)


NO_TIME, TIMED = ("--no-time",), ()


def cut(count: int) -> list[str]:
    """Blocks of a contour of a CAM system."""
    return [
        f"N{i} G1 X{50 * math.cos(i / 900) + i * 1e-5:.3f} Y{50 * math.sin(i / 900):.3f}"
        + (f" Z{-1 - 2 * math.sin(i / 70):.3f}" if i % 3 == 0 else "")
        + (f" F{900 + i // 1000 % 7 * 50}." if i % 1000 == 0 else "")
        for i in range(1, count + 1)
    ]


def lines(count: int = 1_000_000) -> Work:
    """A contour of a CAM system."""
    trace = ("--no-time", "--trace")
    goals = {
        NO_TIME: 20.0,
        TIMED: 8.0,
        (*trace, "out.parquet"): 12.0,
        (*trace, "out.csv"): 3.0,
        (*trace, "out.jsonl"): 3.0,
    }
    blocks = cut(count)
    return replace(both(f"{count:,} G1", blocks, goals), others=_on_others(blocks))


def _on_others(blocks: list[str]) -> dict[str, list[str]]:
    """The same blocks for other controls; a lathe cuts them in its plane."""
    in_plane = [re.sub(" Z[-.0-9]+", "", block).replace("Y", "Z") for block in blocks]
    metric = ["G71 G17 G90 G94", *HEAD[1:]]
    return {
        "meldas-m": [*HEAD, *blocks, *FOOT],
        "syntec-mill": [*metric, *blocks, *FOOT],
        "sinumerik-840d": [*metric, *blocks, *FOOT],
        "fanuc-0i-tf": ["G21 G18 G98", "G54 G0 X0 Z10.", "M3 S800", "G1 F1000.", *in_plane, *FOOT],
    }


def arcs() -> Work:
    """Half circles to and fro."""
    blocks = []
    for i in range(200_000):
        column, goes = i % 100, i // 100 % 2 == 0
        end = 2 * column + 2 if goes else 198 - 2 * column
        blocks.append(f"N{i} G{2 + i % 2} X{end}. Y0. I{1 if goes else -1}. J0.")
    return both("200,000 arcs", blocks, {NO_TIME: 6.0, TIMED: 2.0})


def loop() -> Work:
    """A hot loop."""
    body = ["G1 X[#1*0.001] Y[SIN[#1]*10.]", "#1=[#1+1]"]
    ours = [*HEAD, "#1=0", "WHILE[#1LT300000]DO1", *body, "END1", *FOOT]
    peer = [*HEAD, "#1=0", "o100 while [#1 LT 300000]", *body, "o100 endwhile", *FOOT]
    return Work("300,000 passes of a macro loop", ours, peer, {NO_TIME: 8.0})


def expressions() -> Work:
    """Blocks with expressions, each with other numbers."""
    blocks = [f"G1 X[#1+{i}*0.001] Y[SIN[#2*{i}]*10.+#1/{i + 1}.]" for i in range(200_000)]
    return both("200,000 blocks with expressions", ["#1=1.5", "#2=0.01", *blocks], {NO_TIME: 2.0})


def subprograms() -> Work:
    """Calls of a short subprogram."""
    calls = 100_000
    ours = [*HEAD, *["M98 P1000"] * calls, *FOOT, "O1000", "G91 G1 X0.1", "G90", "M99"]
    peer = ["o1000 sub", "G91 G1 X0.1", "G90", "o1000 endsub", *HEAD, *["o1000 call"] * calls, *FOOT]
    return Work("100,000 M98", ours, peer, {NO_TIME: 2.0})


def macros() -> Work:
    """Calls of a macro with arguments."""
    ours = [f"G65 P1000 A{i % 10}. B{i % 7}.5 C1." for i in range(100_000)]
    peer = [f"o1000 call [{i % 10}.] [{i % 7}.5] [1.]" for i in range(100_000)]
    body = "G1 X[#1+#2] Y#3"
    return Work(
        "100,000 G65",
        [*HEAD, *ours, *FOOT, "O1000", body, "M99"],
        ["o1000 sub", body, "o1000 endsub", *HEAD, *peer, *FOOT],
        {NO_TIME: 2.0},
    )


def holes(code: str, words: str = "") -> Work:
    """A field of holes."""
    first = f"G98 {code} X0 Y0 Z-10. R2.{words} F200."
    return both(f"10,000 holes {code}", [first, *_HOLES, "G80"], {NO_TIME: 2.0, TIMED: 1.0})


def compensated() -> Work:
    """A contour under radius compensation."""
    blocks = [
        f"X{50 * math.cos(i / 300) * (1 + i * 1e-5):.3f} Y{50 * math.sin(i / 300) * (1 + i * 1e-5):.3f}"
        for i in range(200_000)
    ]
    start, end = "X50. Y0. F1000.", ["G40 G1 X0 Y0", *FOOT]
    ours, peer = f"G42 D1 G1 {start}", f"G42.1 D2 G1 {start}"
    setup = "tools:\n  1: {length: 0, radius: 1}\n"
    return Work(
        "G42 over 200,000 blocks",
        [*HEAD, ours, *blocks, *end],
        [*HEAD, peer, *blocks, *end],
        {NO_TIME: 2.0},
        setup,
    )


def all_work() -> list[Work]:
    """Everything that is compared with rs274."""
    return [
        lines(), arcs(), loop(), expressions(), subprograms(), macros(),
        holes("G81"), holes("G83", " Q2."), compensated(),
    ]  # fmt: skip

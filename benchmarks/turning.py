"""Turning cycles of the FANUC lathe: roughing with a pocket, finishing and a thread, expanded again and again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks.measure import Figure, best_of, interpret, rate

if TYPE_CHECKING:
    from collections.abc import Iterator

EXPANSIONS = 200
SHAPE_BLOCKS = 40
MOVES_LIMIT = 20_000


def shape() -> list[str]:
    """40 blocks: tapers, steps and arcs from X20 to X98, in the middle a pocket down to X40."""
    blocks = ["N100 G00 X20. W0", "G01 Z-4. F0.1"]
    diameter, z = 20, -4
    for step in range(7):
        diameter, z = diameter + 4, z - 4
        blocks += [f"G0{2 if step % 2 else 1} X{diameter}. Z{z}." + " R6." * (step % 2), f"G01 Z{z - 3}."]
        z -= 3
    blocks += [f"X40. Z{z - 6}.", f"Z{z - 16}.", f"X{diameter}. Z{z - 22}."]
    z -= 22
    for step in range(10):
        diameter, z = diameter + 4, z - 4
        blocks += [f"G0{3 if step % 2 else 1} X{diameter}. Z{z}." + " R8." * (step % 2), f"G01 Z{z - 1}."]
        z -= 1
    return [*blocks[: SHAPE_BLOCKS - 1], f"N200 X98. Z{z - 10}."]


def program() -> str:
    """G71, G70 and G76 in a loop."""
    lines = [
        "O0001",
        "G97 S1000 M03",
        "#1=0",
        f"WHILE[#1LT{EXPANSIONS}]DO1",
        "G00 X100. Z2.",
        "G71 U1.5 R0.5",
        "G71 P100 Q200 U0.5 W0 F0.3",
        *shape(),
        "G70 P100 Q200",
        "G00 X40. Z4.",
        "G76 P020060 Q100 R0.05",
        "G76 X26. Z-20. P2000 Q400 F2.",
        "#1=#1+1",
        "END1",
        "M30",
    ]
    return "\n".join([*lines, ""])


def cycles() -> Iterator[Figure]:
    """Moves that G71, G70 and G76 make of a program, in a second."""
    text = program()

    def expand() -> int:
        return interpret(text, "fanuc-0i-tf", "lathe2")

    yield rate("G71, G70, G76 with 40 shape blocks", expand() / best_of(expand), MOVES_LIMIT, "moves/s")

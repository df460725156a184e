"""`python -m tests.fuzz.dropped_words CONTROL [MACHINE]`: words of word-address blocks that change nothing.

Each G code of a control's tables is run in a block with words that it takes, once as it is and once for each further
letter beside it. Where rows, alarms and states are the same, nobody has read the word: it is listed with its block.
Not every word that is listed is a fault (R of an arc wins over I and J); one that was meant to move something is.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, TypeAlias

from polycnc.channel.states.state import plain_states, plain_tables
from polycnc.control.registry import control
from tests.support import codes, run

if TYPE_CHECKING:
    from collections.abc import Iterator

#: What comes of a program: alarms, rows, states.
Outcome: TypeAlias = tuple[tuple[str, ...], tuple[str, ...], str]

#: Words beside a code: it is tried with each of these that is no alarm.
MILL = (
    "", "X10.", "X10. Y5.", "X10. Y5. R10.", "X10. Y5. I5. J0", "Z-5. R2.", "X10. Z-5. R2. Q1.", "P1", "P100",
    "L2 P1 X5.", "H1", "D1", "X0 Y0 R30.", "X0 Y0 P2.", "Q1", "I1. J2. K3.", "Z-10. F2.", "X0 Y0 Z0 I10. J20. K5.",
    "A0",
)  # fmt: skip
LATHE = (
    "", "X40.", "X40. Z5.", "X40. Z5. R10.", "X40. Z5. I5. K0", "Z-5. R-2.", "Z-5. R-2. Q1000", "Z-10. F2.", "P1",
    "L2 P1 X5.", "X0 Z0 R30.", "U1. R1.", "X30. Z-5. P500 Q500 F1.", "I5.", "C10.",
)  # fmt: skip
LETTERS = (*"ABCDEHIJKLPQRUVW", ",A", ",C", ",R", ",D", ",S")
SETUP = {"tools": {1: {"radius": 1.0, "length": 5}}}


def outcome(control_id: str, machine: str, program: str) -> Outcome:
    """What comes of a program."""
    channel = run(program, control_id, setup=SETUP, machine=machine, block_limit=20_000)
    rows = tuple(map(repr, channel.toolpath.rows()))
    return tuple(codes(channel)), rows, repr((plain_states(channel), plain_tables(channel)))


def dropped(control_id: str, machine: str) -> Iterator[str]:
    """Blocks with the words that change nothing in them."""
    chosen = control(control_id)
    table = chosen.g_table(run("M30", control_id, machine=machine))  # type: ignore[attr-defined]
    is_lathe = control_id == "fanuc-0i-tf"
    second = "Z" if is_lathe else "Y"
    head = "G98 G0 X50. Z10.\n" if is_lathe else "G90 G54 G0 X0 Y0 Z10.\nG94 F100\n"
    tail = f"\nG1 X13. {second}7. F77\nX17.\nM30\n"
    for code in table:
        known: set[Outcome] = set()
        for words in LATHE if is_lathe else MILL:
            plain = outcome(control_id, machine, f"{head}M3 S500\n{code} {words}{tail}")
            if plain[0] or plain in known:
                continue
            known.add(plain)
            found = [
                letter
                for letter in LETTERS
                if letter not in words
                and outcome(control_id, machine, f"{head}M3 S500\n{code} {words} {letter}3{tail}") == plain
            ]
            if found:
                yield f"{code} {words}: {' '.join(found)}"


def main() -> None:
    """List them."""
    parser = argparse.ArgumentParser(prog="python -m tests.fuzz.dropped_words", description=__doc__)
    parser.add_argument("control")
    parser.add_argument("machine", nargs="?", default="")
    asked = parser.parse_args()
    for line in dropped(asked.control, asked.machine):
        sys.stdout.write(line + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    main()

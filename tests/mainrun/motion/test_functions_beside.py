"""M functions that machine files let go on beside motion: plan, samples and main run take the same time with them."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING

import pytest

from tests.mainrun.motion.both_times import executed, planned

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

#: Seconds of M functions that go on beside the motion of their blocks; M41 is one for which the axes stand.
BESIDE = {3: 0.04, 5: 0.1, 7: 0.05, 8: 0.4, 9: 0.03, 19: 0.02, 68: 0.57, 69: 0.6}
CONTROLS = ("fanuc-m", "fanuc-0i-tf", "meldas-m", "syntec-mill", "sinumerik-840d")
SEEDS = range(40)


def machine(folder: Path, base: str, seconds: Mapping[int, float] = BESIDE) -> str:
    """A machine file with M functions that take these seconds."""
    text = f'base = "{base}"\n[m_function.41]\nseconds = 0.1\n'
    for code, each in seconds.items():
        text += f'[m_function.{code}]\nseconds = {each}\ntiming = "with"\n'
    file = folder / "machine.toml"
    file.write_text(text)
    return str(file)


def same_time(text: str, control: str, file: str, setup: dict[str, object] | None = None) -> float:
    """The time of a program, which is that of its main run."""
    total_s = planned(text, control, file, setup)
    assert executed(text, control, file, setup) == pytest.approx(total_s, abs=5e-4)
    return total_s


class Writer:
    """A random program of incremental moves of any length, with up to two M functions in a block."""

    def __init__(self, control: str, seed: int) -> None:
        self.control, self.draw = control, Random(seed)
        self.is_sinumerik, self.is_lathe = control == "sinumerik-840d", control == "fanuc-0i-tf"

    def text(self) -> str:
        """The whole program, perhaps with a subprogram of one line or two that runs twice."""
        blocks = [self._head(), *(self._block() for _ in range(self.draw.randint(4, 14)))]
        if self.is_sinumerik:
            return "\n".join([*blocks, "AGAIN: G1 X1 M8", "REPEATB AGAIN P=2", "M30", ""])
        if self.is_lathe:
            return "\n".join(["O1", *blocks, "M30", ""])
        call = "M98 P20002" if self.control == "fanuc-m" else "M98 P2 L2"
        return "\n".join(["O1", *blocks, call, "M30", "O2", "G91 G1 X1. M8", "M99", ""])

    def _head(self) -> str:
        feed = f"F{self.draw.choice((600, 3000, 8000))}"
        if self.is_lathe:
            return f"G98 {feed}"
        if self.is_sinumerik:
            rounded = self.draw.choice(("G64", "G60", "G641 ADIS=0.5", "G642"))
            return f"G91 G94 {rounded} {self.draw.choice(('SOFT', 'BRISK'))} {feed}"
        return f"G91 G94 {self.draw.choice(('G64', 'G61'))} {feed}"

    def _block(self) -> str:
        draw, words = self.draw, list[str]()
        kind = draw.random()
        if kind < 0.7:
            axis = draw.choice("UW" if self.is_lathe else "XYZ")
            way = draw.choice((-1, 1)) * draw.choice((0.05, 0.3, 1.0, 5.0, 20.0))
            words = [draw.choice(("G1", "G1", "G0")), f"{axis}{way:.3f}"]
        elif kind < 0.8:
            words = ["G4", "F0.1" if self.is_sinumerik else "P100"]
        if not words and draw.random() < 0.3:
            return f"S{draw.choice((500, 2000))} M3"
        most = 1 if self.is_lathe else 2
        return " ".join(
            [*words, *(f"M{code}" for code in draw.sample((8, 9, 7, 41, 5), draw.randint(0, most)))]
        )


@pytest.mark.parametrize("seed", SEEDS)
def test_plan_samples_and_main_run_wait_alike(tmp_path: Path, seed: int) -> None:
    control = CONTROLS[seed % len(CONTROLS)]
    setup: dict[str, object] = {"parameters": {"3404#7": 1}} if control == "fanuc-m" else {}
    file = machine(tmp_path, "lathe2" if control == "fanuc-0i-tf" else "mill3")
    same_time(Writer(control, seed).text(), control, file, setup)


LOOPS = {
    "fanuc-m": "O1\nG91 G94 F3000 G64\n#1=0\nWHILE [#1 LT 4] DO1\nG1 X5. M8\n#1=#1+1\nEND1\nM30\n",
    "meldas-m": "O1\nG91 G94 F3000 G64\nM98 P2 L4\nM30\nO2\nG1 X5. M8\nM99\n",
    "syntec-mill": "O1\nG91 G94 F3000 G64\nM98 P2 L4\nM30\nO2\nG1 X5. M8\nM99\n",
    "sinumerik-840d": "G91 G94 F3000 G64\nR1=0\nWHILE R1<4\nG1 X5 M8\nR1=R1+1\nENDWHILE\nM30\n",
}


@pytest.mark.parametrize("control", LOOPS)
def test_every_pass_of_a_loop_waits_for_its_function(tmp_path: Path, control: str) -> None:
    assert same_time(LOOPS[control], control, machine(tmp_path, "mill3")) == pytest.approx(4 * BESIDE[8])


DEEP = (
    "CYCLE830(20,0,2,-60,0,0,0,0,0,21103,0,0,0.5,0,300,5,0,120,3,900,0,0,0,20,50,4,0,0,5,40,400,3,100,"
    '"M8","M9",0,0,0,0,0,1)'
)
CYCLES = {
    "fanuc-m": "G90 S300 M3\nG0 Z12.\nG86 X9. Z-7. R3. F300\nG76 X12. Q1. M8\nG84 X4.\nG80\nM30\n",
    "meldas-m": "G90 S300 M3\nG0 Z12.\nG86 X9. Z-7. R3. F300\nG84 X4. F1. M8\nG80\nM30\n",
    "syntec-mill": "G90 S800 M3\nG0 Z12.\nG76 X5. Y5. Z-6. R2. Q1.5 P2. F100\nG86 X9. M8\nG80\nM30\n",
    "sinumerik-840d": (
        f"T1 D1 M6\nG54 G90 G17 G0 X0 Y0 Z50\nS2000 M3 F300\n{DEEP}\nCYCLE82(10,0,2,-6,,0.2)\nX9 M8\nM30\n"
    ),
    "fanuc-0i-tf": "G98 G0 X40. Z2. C0\nG83 Z-5. R-1. F100. M68\nC90.\nG80\nG83 Z-5. R-1.\nG80\nM30\n",
}


@pytest.mark.parametrize("scale", [0.05, 1.0, 10.0])
@pytest.mark.parametrize("control", CYCLES)
def test_so_do_blocks_of_cycles(tmp_path: Path, control: str, scale: float) -> None:
    seconds = {code: scale * each for code, each in BESIDE.items()}
    setups: dict[str, dict[str, object]] = {
        "fanuc-0i-tf": {"parameters": {"5110": 68, "5111": 100}},
        "sinumerik-840d": {"tools": {1: {"length": 50.0, "radius": 4.0, "type": 200}}},
    }
    file = machine(tmp_path, "lathe-c" if control == "fanuc-0i-tf" else "mill3", seconds)
    same_time(CYCLES[control], control, file, setups.get(control))


def test_what_stands_waits_for_no_function_beside_the_motion(tmp_path: Path) -> None:
    file = machine(tmp_path, "mill3")
    text = "O1\nG91 G94 F3000\nG1 X5. M8 S3000\nX5.\nM30\n"
    for control in ("fanuc-m", "meldas-m", "syntec-mill"):
        assert same_time(text, control, file) < BESIDE[8] + 0.3


#: Blocks that a function may outlast or not, by how fast what comes before them, or a law, lets them be.
NEARLY = {
    "arc by a law": ("syntec-mill", "F3000\nG3 X0.5 R0.5 M8\nG1 Y1.\nM30\n"),
    "rounded by a law": ("sinumerik-840d", "G641 ADIS=0.5 SOFT F3000\nG1 Y1 G91\nX1 M8\nX5\nM30\n"),
    "planned ahead": ("fanuc-m", "G05.1 Q1\nF8000\nG1 X20.\nG3 Y0.5 R0.5 M8\nG1 X-0.3\nM30\n"),
    "behind a cut line": ("fanuc-m", "F8000\nG1 X20.\nG3 Y0.5 R0.5 M8\nX-0.3\nM30\n"),
    "lines beside arcs": (
        "meldas-m",
        "F6000\nM98 P2 L3\nM30\nO2\nG91 G1 X10. Y5. M8\nG2 X4. R2.\nM99\n",
    ),
}


@pytest.mark.parametrize("seconds", [0.005, 0.011, 0.02, 0.04, 0.06, 0.08, 0.1, 0.2])
@pytest.mark.parametrize("kind", NEARLY)
def test_plan_and_main_run_find_alike_what_outlasts_a_block(
    tmp_path: Path, kind: str, seconds: float
) -> None:
    control, text = NEARLY[kind]
    same_time(text, control, machine(tmp_path, "mill3", {8: seconds}))


#: Heads and ends of contours whose moves a stage of the path holds, and the words of their tool.
HELD: dict[str, tuple[str, str, str, dict[str, object]]] = {
    "fanuc-m": ("O1\nG41 G01 X10. Y10. D1 F6000", "G40 X200.", "M30\n", {"tools": {"1": {"radius": 0.05}}}),
    "meldas-m": ("O1\nG41 G01 X10. Y10. D1 F6000", "G40 X200.", "M30\n", {"tools": {"1": {"radius": 0.05}}}),
    "syntec-mill": (
        "O1\nG41 G01 X10. Y10. D1 F6000",
        "G40 X200.",
        "M30\n",
        {"tools": {"1": {"radius": 0.05}}},
    ),
    "sinumerik-840d": ("COMPCURV G1 X10 Y10 F6000", "COMPOF X200", "M30\n", {}),
}


@pytest.mark.parametrize("control", HELD)
def test_so_it_is_where_a_stage_holds_the_moves_of_a_block(control: str, tmp_path: Path) -> None:
    head, leave, end, setup = HELD[control]
    file = machine(tmp_path, "mill3")
    for seed in range(20):
        draw, x, blocks = Random(seed), 10.0, [head]
        for _ in range(draw.randint(3, 8)):
            x += draw.choice((0.5, 4.0, 30.0))
            words = [f"X{x:.1f}", f"Y{draw.uniform(5.0, 40.0):.1f}", *draw.choice(((), ("M08",), ("M68",)))]
            draw.shuffle(words)
            blocks.append(" ".join(words))
            if draw.random() < 0.3:
                blocks.append(draw.choice(("M09", "M41")))
        same_time("\n".join((*blocks, leave, end)), control, file, setup)


def test_a_function_in_a_compensated_block_goes_on_beside_its_motion(tmp_path: Path) -> None:
    head, leave, end, setup = HELD["fanuc-m"]
    file = machine(tmp_path, "mill3")
    times = [
        same_time("\n".join((head, f"X90. {word}", "Y50.", leave, end)), "fanuc-m", file, setup)
        for word in ("", "M08")
    ]
    assert times[1] == pytest.approx(times[0], abs=0.02)

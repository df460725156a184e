"""Programs of plain and other blocks mixed, for every control, as Hypothesis strategies."""

from __future__ import annotations

from hypothesis import strategies as st

#: Spindle speeds, right ones and some that a control may refuse.
SPEEDS = (" S1200", "S800", " S1200", " S0", " S1500.", " S99.5", "S-5")
CODES = ("G1 ", "G1", "G01 ", "G0 ", "G00", "G90 ", "G91 ", "G90G1 ", "G0 G91 ")
#: Codes that are mostly in force already, or change no way.
REPEATED = (
    "G17 ",
    "G17G1",
    "G54 ",
    "G54 G17 G90 ",
    "G94 ",
    "G94",
    "G40 ",
    "G64 ",
    "G61 ",
    "G21 ",
    "G1 G97 ",
    "G69 ",
    "G50 ",
    "G23 ",
)
REPEATED_SINUMERIK = (
    "G17 ",
    "G17G1",
    "G54 ",
    "G54 G17 G90 ",
    "G94 ",
    "G94",
    "G40 ",
    "G64 ",
    "G60 ",
    "G71 ",
    "G1 G40 G64 ",
    "G500 ",
)
REPEATED_LATHE = (
    "G18 ",
    "G18G1",
    "G54 ",
    "G54 G18 ",
    "G98 ",
    "G98",
    "G64 ",
    "G61 ",
    "G21 ",
    "G1 G97 ",
    "G69.1 ",
)
_decimals = st.integers(0, 6)


@st.composite
def number(draw: st.DrawFn, most: int = 200) -> str:
    """A coordinate as programs write it: `10`, `-3.`, `.5`, `+12.3456`."""
    sign = draw(st.sampled_from(("", "", "", "-", "-", "+")))
    whole = draw(st.integers(0, most))
    style = draw(st.sampled_from(("point", "point", "point", "decimals", "whole", "bare")))
    if style == "whole":
        return f"{sign}{whole * 100}"
    if style == "point":
        return f"{sign}{whole}."
    decimals = draw(_decimals)
    fraction = str(draw(st.integers(0, 10**decimals - 1))).zfill(decimals) if decimals else "0"
    return f"{sign}.{fraction}" if style == "bare" else f"{sign}{whole}.{fraction}"


def words(letters: str, most: int = 200, equals: bool = False) -> st.SearchStrategy[str]:
    """Some of the letters with a number each, in any order."""

    @st.composite
    def some(draw: st.DrawFn) -> str:
        chosen = draw(st.lists(st.sampled_from(letters), unique=True, max_size=len(letters)))
        blank = draw(st.sampled_from((" ", " ", "", "  ")))
        signs = [draw(st.sampled_from(("", "=")) if equals else st.just("")) for _ in chosen]
        parts = [f"{letter}{sign}{draw(number(most))}" for letter, sign in zip(chosen, signs, strict=True)]
        return blank.join(parts)

    return some()


@st.composite
def plain(
    draw: st.DrawFn,
    axes: str,
    comments: tuple[str, ...],
    codes: tuple[str, ...] = CODES,
    equals: bool = False,
) -> str:
    """A plain block as CAM systems and people write it."""
    head = draw(st.sampled_from(("", "", "", "N10 ", "N0020", " ")))
    code = draw(st.sampled_from((*[""] * len(codes), *codes)))
    feed = draw(st.sampled_from((*[""] * 12, " F500", " F1200.", "F33.5", *[" F700.5"] * 4)))
    speed = draw(st.sampled_from((*[""] * 30, *SPEEDS[:3] * 3, *SPEEDS)))
    behind = draw(st.sampled_from(("", "", "", *comments)))
    before, after = (speed, "") if draw(st.booleans()) else ("", speed)
    return head + code + before + draw(words(axes, equals=equals)) + feed + after + behind


@st.composite
def arc(draw: st.DrawFn, comments: tuple[str, ...]) -> str:
    """An arc whose end lies on its circle."""
    code = draw(st.sampled_from(("G17 G2 ", "G17G3 ", "G17 G02", "G17 G3 ")))
    size = draw(st.integers(1, 40))
    kind = draw(st.sampled_from(("quarter", "half", "full", "radius")))
    feed = draw(st.sampled_from(("", "", " F300.")))
    shape = {
        "quarter": f"G91 {code}X{size}. Y{size}. I{size}. J0",
        "half": f"G91 {code}X{2 * size}. Y0. Z{draw(number(5))} I{size}.",
        "full": f"{code}I{size}. J-{size}.5",
        "radius": f"G91 {code}X{draw(number(20))} Y{draw(number(20))} R{draw(st.sampled_from(('', '-')))}{20 + size}.",
    }[kind]
    behind = draw(st.sampled_from(("\nG1", "\nG01", "\nG0", "\nG90 G1", "\nG1 G17 ")))
    return shape + feed + draw(st.sampled_from(("", *comments))) + behind


def any_arc() -> st.SearchStrategy[str]:
    """An arc block with any words; hardly ever a right one."""
    return st.tuples(st.sampled_from(("G2 ", "G90 G3 ")), words("XYZ", 50), words("IJR", 50)).map("".join)


def program(
    plain_block: st.SearchStrategy[str],
    others: st.SearchStrategy[str],
    wrong: st.SearchStrategy[str],
    head: str,
    foot: str,
) -> st.SearchStrategy[str]:
    """Runs of plain blocks with other blocks between them, a wrong one among them now and then."""
    section = st.tuples(st.lists(plain_block, min_size=1, max_size=12), st.lists(others, max_size=3))
    sections = st.lists(section, min_size=1, max_size=10)
    last = st.one_of(st.just(""), st.just(""), st.just(""), wrong)

    def text(parts: tuple[list[tuple[list[str], list[str]]], str, list[str]]) -> str:
        good, bad, behind = parts
        lines = [line for stretch, between in good for line in (*stretch, *between)]
        return "\n".join((head, *lines, bad, *behind, foot, ""))

    return st.tuples(sections, last, st.lists(plain_block, max_size=4)).map(text)

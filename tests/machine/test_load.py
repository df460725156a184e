"""Machine files of the user: what they can leave out, and how mistakes are told."""

import re
from collections.abc import Callable
from math import inf
from pathlib import Path

import pytest

from polycnc.machine.errors import MachineFileError, catalogue
from polycnc.machine.load import load_machine

Write = Callable[..., Path]
CHANNEL = '[channel.1]\naxes = ["X", "Y"]\n'


@pytest.fixture
def write(tmp_path: Path) -> Write:
    def to_file(text: str, name: str = "mine.toml") -> Path:
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return to_file


def test_a_channel_is_all_that_a_machine_needs(write: Write) -> None:
    machine = load_machine(write('[channel.1]\naxes = ["X", "Y", "Z", "A"]\n'))
    assert machine.id == "mine"
    assert [axis.rotary for axis in machine.axes] == [False, False, False, True]
    assert machine.axis["A"].modulo
    assert machine.axis["X"].limit_plus == inf
    assert machine.geometry_indices(1) == (0, 1, 2)
    assert [joint.axis for joint in machine.joints] == ["X", "Y", "Z"]


def test_a_file_says_only_what_differs_from_its_base(write: Write) -> None:
    machine = load_machine(write('base = "mill3"\n[axis.Z]\nlimit_minus = -400\nlimit_plus = 0\n'))
    base = load_machine("mill3")
    assert (machine.axis["Z"].limit_minus, machine.axis["Z"].limit_plus) == (-400.0, 0.0)
    assert machine.axis["Z"].rapid == base.axis["Z"].rapid
    assert machine.spindles == base.spindles
    assert str(machine.name) == "mine"


def test_a_base_can_be_a_file_beside_it(write: Write) -> None:
    write('base = "lathe2"\n[defaults.linear]\nrapid = 6000\n', "family.toml")
    machine = load_machine(write('base = "family.toml"\n[axis.X]\nrapid = 3000\n'))
    assert (machine.axis["X"].rapid, machine.axis["Z"].rapid) == (50.0, 100.0)
    assert machine.axis["X"].diameter


def test_reference_points_that_are_left_out_lie_on_the_last_one(write: Write) -> None:
    machine = load_machine(write(CHANNEL + "[axis.X]\nreference_points = [-10, -20]\n"))
    assert machine.axis["X"].reference_points == (-10.0, -20.0, -20.0, -20.0)


def test_overtravel_tells_the_side(write: Write) -> None:
    axis = load_machine(write(CHANNEL + "[axis.X]\nlimit_minus = -10\nlimit_plus = 20\n")).axis["X"]
    assert [axis.overtravel(x) for x in (-10.001, -10.0, 20.0, 20.001)] == [-1, 0, 0, 1]


def test_byte_order_mark_of_an_editor_does_no_harm(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(CHANNEL, encoding="utf-8-sig")
    assert load_machine(path).channel_axes(1) == ("X", "Y")


JOINT = '[[joint]]\naxis = "X"\ncarries = "tool"\ndirection = [1, 0, 0]\n'


@pytest.mark.parametrize(
    ("text", "line", "column", "message"),
    [
        (CHANNEL + "[axis.X]\nrapit = 3\n", 4, 1, "unknown-key"),
        (CHANNEL + "[axis.X]\ncolour = 3\n", 4, 1, "unknown-key"),
        (CHANNEL + '[axis.X]\nrapid = "fast"\n', 4, 1, "needs-number"),
        (CHANNEL + "[axis.X]\nrapid = nan\n", 4, 1, "needs-number"),
        (CHANNEL + "[axis.X]\nrapid = 0\n", 4, 1, "out-of-range"),
        (CHANNEL + "[axis.X]\nmodulo = 1\n", 4, 1, "needs-true-or-false"),
        (CHANNEL + "[axis.X]\nmodulo = true\n", 4, 1, "only-rotary"),
        (CHANNEL + "[axis.X]\n\nlimit_minus = 3\nlimit_plus = 1\n", 5, 1, "limits-crossed"),
        (CHANNEL + "[axis.X]\nlimit_plus = -1\nreference_points = [0]\n", 5, 1, "reference-beyond-limit"),
        (CHANNEL + "[axis.X]\nreference_points = [0, 0, 0, 0, 0]\n", 4, 1, "wrong-length"),
        (CHANNEL + '[axis.X]\nparallel_to = "Q"\n', 4, 1, "unknown-axis"),
        (CHANNEL + "[axis.Z]\nrapid = 3\n", 3, 2, "axis-unused"),
        (CHANNEL + "[axis.X\nrapid = 3\n", 3, 8, "not-toml"),
        (CHANNEL + "spindles = [3]\n", 3, 1, "unknown-spindle"),
        (CHANNEL + 'names = ["X"]\n', 3, 1, "names-do-not-match"),
        (CHANNEL + 'names = ["X", "X"]\n', 3, 1, "named-twice"),
        (CHANNEL + 'geometry = { X = "Q" }\n', 3, 14, "unknown-axis"),
        (CHANNEL + 'virtual = ["Y"]\n', 3, 1, "virtual-is-real"),
        (CHANNEL + JOINT + "\n" + JOINT.replace('"X"', '"Q"'), 9, 1, "axis-unused"),
        (CHANNEL + JOINT + "\n" + JOINT.replace("tool", "hand"), 10, 1, "not-one-of"),
        (CHANNEL + JOINT + "\n" + JOINT.replace("[1, 0, 0]", "[0, 0, 0]"), 11, 1, "no-direction"),
        (CHANNEL + JOINT + '\n[[joint]]\naxis = "Y"\ndirection = [1, 0, 0]\n', 8, 3, "missing-key"),
        ("tool_direction = [0, 0, 0]\n" + CHANNEL, 1, 1, "no-tool-direction"),
        ("nose = [0, 0]\n" + CHANNEL, 1, 1, "wrong-length"),
        ("settle_fine_s = 0.02\nsettle_coarse_s = 0.03\n" + CHANNEL, 2, 1, "windows-crossed"),
        ("settle_coarse_s = 0.03\n" + CHANNEL, 1, 1, "windows-crossed"),
        (CHANNEL + "[spindle.1]\nmin_rpm = 100\nmax_rpm = 50\n", 4, 1, "speeds-crossed"),
        (CHANNEL + "[magazine]\nplaces = 2.5\n", 4, 1, "needs-whole-number"),
        (CHANNEL + "[magazine]\nchange_at = { Z = [1] }\n", 4, 15, "unknown-axis"),
        (CHANNEL + '[m_function.8]\nname = { en = "A", de = "B" }\n', 4, 20, "unknown-key"),
        (CHANNEL + "[m_function.8]\nname = 8\n", 4, 1, "needs-table"),
        ('[channel.one]\naxes = ["X"]\n', 1, 2, "bad-name"),
        ('[channel.1]\naxes = "X"\n', 2, 1, "needs-list"),
        ("[channel.1]\nspindles = []\n", 1, 2, "missing-key"),
        ('[[channel]]\naxes = ["X"]\n', 1, 3, "needs-table"),
        ('base = "mill99"\n', 1, 1, "no-such-machine"),
        ('\nbase = "mine.toml"\n', 2, 1, "base-of-itself"),
        ("", 0, 0, "no-axes"),
    ],
)
def test_a_mistake_is_told_with_its_line(
    write: Write, text: str, line: int, column: int, message: str
) -> None:
    path = write(text)
    with pytest.raises(MachineFileError) as caught:
        load_machine(path)
    error = caught.value
    assert (error.line, error.column, error.message) == (line, column, message)
    place = f"{path}:{line}:{column}: " if line else f"{path}: "
    for lang in ("en", "zh-TW"):
        shown = error.text(lang)
        assert shown.startswith(place)
        assert not re.search(r"\{[a-z]+\}", shown.removeprefix(place))


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ('axes = ["X"]\n', "axes is a key of channel.NUMBER; did you mean axis?"),
        (CHANNEL + '[axis.X]\nbase = "mill3"\n', "base is a key of the top level"),
        ("rapit = 3\n", "rapid is a key of defaults.linear, defaults.rotary, axis.NAME"),
        (CHANNEL + "[axis.X]\nrapit = 3\n", "did you mean rapid?"),
        (
            CHANNEL + "[magazine]\naxis = 3\n",
            "axis is a key of spindle.NUMBER, joint; axis is a key of",
        ),
        (
            CHANNEL + "[spindle.1]\ngears = [{ min_rpm = 0, max_rpm = 1, places = 3 }]\n",
            "places is a key of magazine",
        ),
        (CHANNEL + "[axis.X]\ncolour = 3\n", ""),
    ],
)
def test_an_unknown_key_says_where_it_belongs_and_never_what_was_typed(
    write: Write, text: str, meant: str
) -> None:
    with pytest.raises(MachineFileError) as caught:
        load_machine(write(text))
    says = caught.value.text("en").partition("there is no such key here")[2]
    assert says.startswith(f"; {meant}" if meant else "")
    assert bool(says) == bool(meant)


def test_a_mistake_in_the_base_names_the_base(write: Write) -> None:
    base = write(CHANNEL + "[axis.X]\nrapid = -1\n", "family.toml")
    with pytest.raises(MachineFileError) as caught:
        load_machine(write('base = "family.toml"\n'))
    assert (caught.value.path, caught.value.line) == (str(base), 4)


def test_the_first_of_several_mistakes_is_told(write: Write) -> None:
    text = CHANNEL + "[axis.Y]\nrapid = -1\n[axis.X]\nrapid = -1\n"
    with pytest.raises(MachineFileError) as caught:
        load_machine(write(text))
    assert caught.value.line == 4


@pytest.mark.parametrize("name", ["mill99", "../builtin/mill3", "family/mill", "absent.toml", ""])
def test_an_unknown_machine_is_not_a_traceback(name: str) -> None:
    with pytest.raises(MachineFileError) as caught:
        load_machine(name)
    assert caught.value.message == "no-such-machine"


def test_a_file_that_is_not_text_is_told(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(MachineFileError) as caught:
        load_machine(path)
    assert caught.value.message == "unreadable"


def test_every_message_exists_in_both_languages() -> None:
    for key in catalogue():
        entry = catalogue().entry(key)
        assert set(entry) == {"en", "zh-TW"}
        assert entry["en"] != entry["zh-TW"]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ('[channel.2]\naxes = ["X", "Y", "Z"]\n', "channel 1 is missing"),
        (f'base = "{"9" * 400}"\n', "there is no machine"),
        ("a = " + "[" * 5000, "nested too deep"),
        ("a = " + "9" * 5000, "very many digits"),
    ],
)
def test_a_file_beyond_all_bounds_is_refused(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "machine.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(MachineFileError, match=message):
        load_machine(path)


def test_a_machine_that_comes_with_polycnc_is_read_once() -> None:
    assert load_machine("mill3") is load_machine("mill3")

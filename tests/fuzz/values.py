"""Values of setups, changed: leaves become extreme, keys are those of others, tables are nested, doubled or dropped."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import yaml

if TYPE_CHECKING:
    from random import Random

LEAVES: tuple[object, ...] = (
    0, 1, -1, 2, 9, 99, 100, 255, 256, 65_536, 99_999_999, 2**31, 2**63, 10**30, 10**309, -(10**400), 0.5, -0.5, 1e-9,
    1e9, -1e9, 1e15, 1e300, -1e300, 1e308, float("inf"), float("-inf"), float("nan"), True, False, None, "", "X", "1",
    "-1", "1:30", "010", "1e5", "on", "軸", "x" * 5000, "9" * 5000, [], {}, [0], [1, 2, 3], [[[]]], {"X": 1}, {1: 2},
    {"": None}, [None], {"X": {"X": {}}},
)  # fmt: skip


def _bomb(begin: str, element: str, levels: int) -> str:
    """A document in which every line has what stands before it nine times."""
    names = "abcdefghijklmnopqrstuvwxyz"
    lines = [
        f"{names[i + 1]}: &{names[i + 1]} " + element % ", ".join([f"*{names[i]}"] * 9) for i in range(levels)
    ]
    return "\n".join(["", f"a: &a {begin}", *lines, ""])


#: Ends of YAML documents that no dump writes.
TAILS = (
    "\nstart: {X: 1}\nstart: {X: 2}\n", '\nvariables: {"#1": 010}\n', '\nvariables: {"#1": 1:30}\n',
    "\na: &a [*a]\n", "\nvariables: &v {a: *v}\n", "\n- 1\n", "\n...\n---\nstart: {}\n",
    "\nstart: !!python/object:os.system {}\n", "\nvariables: {x: !!binary 'AAAA'}\n",
    "\nvariables: {x: 2020-01-01}\n", "\n? [1, 2]\n: 3\n", "\nstart: {? {X: 1} : 2}\n",
    "\nstart: " + "[" * 3000 + "\n", "\nstart: " + "{X: " * 3000 + "\n",
    '\nvariables: {"#1": ' + "9" * 5000 + "}\n", "\n<<: {start: {X: 1}}\n", "\nstart: {<<: [{X: 1}, {X: 2}]}\n",
    "\ttools:\n", "\n\x00", "\n%YAML 9.9\n", "\n*nothing\n", _bomb("{x: 1}", "{<<: [%s]}", 9), _bomb("[1]", "[%s]", 12),
)  # fmt: skip
KEYS = (0, 1, -1, 99, 10**9, "X", "Q", "", "G54", "G54.1 P48", "G99", "#1", "5102#9", "5102#0 X", "軸")


def changed(random: Random, value: dict[str, object], other: dict[str, object]) -> dict[str, object]:
    """A setup with one to four changes; the argument stays as it is."""
    copy: dict[str, object] = _copied(value)
    for _ in range(random.choice((1, 1, 2, 4))):
        what = random.randrange(10)
        if what < 5:
            _change_leaf(random, copy)
        elif what < 8 and other:
            key = random.choice(list(other))
            below, taken = copy.get(key), _copied(other[key])
            if isinstance(below, dict) and isinstance(taken, dict):
                below.update(taken)
            else:
                copy[key] = taken
        else:
            _change_key(random, copy)
    return copy


def document(random: Random, value: dict[str, object]) -> str:
    """A setup as a YAML text, now and then with an end that no dump writes."""
    flow = random.choice((None, True, False))
    text: str = yaml.safe_dump(value, allow_unicode=random.random() < 0.9, default_flow_style=flow)
    return text + random.choice(TAILS) if random.random() < 0.15 else text


def _copied(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _copied(element) for key, element in value.items()}
    return [_copied(element) for element in value] if isinstance(value, list) else value


def _tables(value: object) -> list[dict[object, object] | list[object]]:
    """Every table and list of a value, with itself."""
    if not isinstance(value, dict | list):
        return []
    elements = value.values() if isinstance(value, dict) else value
    return [value, *(table for element in elements for table in _tables(element))]


def _change_leaf(random: Random, value: object) -> None:
    table: Any = random.choice(_tables(value))
    if not table:
        return
    at = random.choice(list(table)) if isinstance(table, dict) else random.randrange(len(table))
    if isinstance(table[at], dict | list) and random.random() < 0.7:
        return
    table[at] = _copied(random.choice(LEAVES))


def _change_key(random: Random, value: object) -> None:
    tables = [table for table in _tables(value) if isinstance(table, dict) and table]
    if tables:
        table = random.choice(tables)
        key = random.choice(list(table))
        element = table[key]
        if random.random() < 0.5:
            del table[key]
        new = random.choice(KEYS)
        table[new] = element

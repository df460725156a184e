"""How Python calls the machine code of a kernel: with addresses in place of its arrays and records."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from polycnc.kernels.c_types import Integer, Number, Pointer, addressof
from polycnc.kernels.description import INTEGER, NUMBER, RECORD

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

#: So many calls take their arguments apart one by one before that is written out for a kernel: it makes each faster
#: by a third, and takes as long as some hundred calls.
_FEW = 512
_TYPES = {RECORD: (Pointer,), INTEGER: (Integer,), NUMBER: (Number,)}
_ARRAY = Pointer, Integer
_BRACKETS = str.maketrans("", "", "()")


def caller(entry: Any, signature: str) -> Callable[..., Any]:
    """What is called like a kernel, and calls its machine code.

    Args:
        entry: The function of the shared object; it learns here what it takes.
        signature: What the kernel takes (`description`).
    """
    codes = signature.translate(_BRACKETS)
    entry.argtypes = [each for code in codes for each in _TYPES.get(code, _ARRAY)]
    left = _FEW
    written: Callable[..., Any] | None = None

    def call(*given: Any) -> Any:
        nonlocal left, written
        if left:
            left -= 1
            return entry(*_handed(given, codes))
        if written is None:
            written = _written(entry, signature)
        return written(*given)

    return call


def _handed(given: Iterable[Any], codes: str) -> list[Any]:
    """Arguments of a kernel as its machine code takes them."""
    handed: list[Any] = []
    for each, code in zip(_apart(given), codes, strict=True):
        if code in _TYPES:
            handed.append(addressof(each) if code == RECORD else each)
        elif each.typecode == code:
            handed += each.buffer_info()
        else:
            _refuse(code, each.typecode)
    return handed


def _apart(given: Iterable[Any]) -> Iterator[Any]:
    """Arguments with groups taken apart."""
    for each in given:
        if isinstance(each, tuple):
            yield from _apart(each)
        else:
            yield each


def _written(entry: Any, signature: str) -> Callable[..., Any]:
    """The same, written out for what the kernel takes."""
    names, codes = _names(signature), signature.translate(_BRACKETS)
    arrays = [(name, code) for name, code in zip(names, codes, strict=True) if code not in _TYPES]
    wanted = "".join(code for _, code in arrays)
    given = (
        f"addressof({name})" if code == RECORD else name if code in _TYPES else f"*{name}.buffer_info()"
        for name, code in zip(names, codes, strict=True)
    )
    count = len({name.partition("[")[0] for name in names})
    source = (
        f"def call({', '.join(f'a{i}' for i in range(count))}):\n"
        f"    found = ({''.join(f'{name}.typecode, ' for name, _ in arrays)})\n"
        "    if found != codes: refuse(wanted, ''.join(found))\n"
        f"    return entry({', '.join(given)})\n"
    )
    scope = {
        "entry": entry, "addressof": addressof, "codes": tuple(wanted), "wanted": wanted,
        "refuse": _refuse,
    }  # fmt: skip
    exec(source, scope)
    call: Callable[..., Any] = scope["call"]
    return call


def _names(signature: str) -> list[str]:
    """Where the parts of the arguments stand: `a0` for the first one, `a1[2]` for the third one of a group."""
    names: list[str] = []
    places = [0]
    for sign in signature:
        if sign == "(":
            places.append(0)
            continue
        if sign == ")":
            places.pop()
        else:
            first, *others = places
            names.append(f"a{first}{''.join(f'[{place}]' for place in others)}")
        places[-1] += 1
    return names


def _refuse(wanted: str, found: str) -> None:
    msg = f"a kernel was given arrays of {found}, not of {wanted}"
    raise TypeError(msg)

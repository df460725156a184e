"""How Python calls the machine code of a kernel: with addresses in place of its arrays and records.

All that it takes is handed over as one block of numbers of eight bytes each. To hand over one by one what laws of third
order take, `ctypes` needs as long as their machine code for five rows of a contour.
"""

from __future__ import annotations

from _struct import Struct
from array import array
from itertools import accumulate, chain
from operator import attrgetter, itemgetter

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.kernels.c_types import Pointer, addressof, place_of
from polycnc.kernels.description import INTEGER, NUMBER, RECORD, TEXT

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence

#: So many calls hand their arguments on one by one before that is written out for a kernel: it makes each faster by a
#: third, and takes as long as some hundred calls.
_FEW = 128
#: What stands in the block for each, as `struct` names it: an array is its address and its length.
_FORMS, _ARRAY = {TEXT: "Qq", RECORD: "Q", INTEGER: "q", NUMBER: "d"}, "Qq"
_BRACKETS = str.maketrans("", "", "()")
#: Expressions for arguments that are no arrays, by their signs.
_HANDED = {TEXT: "place_of({0}), len({0})", RECORD: "addressof({0})", INTEGER: "{0}", NUMBER: "{0}"}
_typecode = attrgetter("typecode")


def caller(entry: Any, signature: str) -> Callable[..., Any]:
    """What is called like a kernel, and calls its machine code.

    Args:
        entry: The function of the shared object; it learns here what it takes.
        signature: What the kernel takes (`description`).
    """
    codes = signature.translate(_BRACKETS)
    entry.argtypes = [Pointer]
    pack = Struct("".join(_FORMS.get(code, _ARRAY) for code in codes)).pack
    hand = _hander(codes)
    left = _FEW
    written: Callable[..., Any] | None = None

    def call(*given: Any) -> Any:
        nonlocal left, written
        if left:
            left -= 1
            return entry(pack(*hand(given)))
        if written is None:
            written = _written(entry, pack, signature)
        return written(*given)

    return call


def _hander(codes: str) -> Callable[[Iterable[Any]], list[Any]]:
    """What makes of the arguments of a kernel those of its machine code."""
    wanted = "".join(code for code in codes if code not in _FORMS)
    arrays = [i for i, code in enumerate(codes) if code not in _FORMS]
    pick = itemgetter(*arrays) if len(arrays) > 1 else lambda flat: [flat[i] for i in arrays]
    others = [(i, code) for i, code in enumerate(codes) if code in _FORMS]
    places = [0, *accumulate(len(_FORMS.get(code, _ARRAY)) for code in codes)]

    def hand(given: Iterable[Any]) -> list[Any]:
        flat: list[Any] = []
        for each in given:
            if isinstance(each, tuple):
                flat += each
            else:
                flat.append(each)
        if len(flat) != len(codes):
            raise ValueError(f"a kernel was given {len(flat)} arguments, not {len(codes)}")
        found = pick(flat)
        if "".join(map(_typecode, found)) != wanted:
            _refuse(wanted, found)
        handed = [*chain.from_iterable(map(array.buffer_info, found))]
        for i, code in others:
            handed[places[i] : places[i]] = _handed(flat[i], code)
        return handed

    return hand


def _handed(value: Any, code: str) -> Sequence[Any]:
    """An argument that is no array."""
    if code == RECORD:
        return (addressof(value),)
    return (place_of(value), len(value)) if code == TEXT else (value,)


def _written(entry: Any, pack: Callable[..., bytes], signature: str) -> Callable[..., Any]:
    """The same, written out for what the kernel takes."""
    names, codes = _names(signature), signature.translate(_BRACKETS)
    arrays = [(name, code) for name, code in zip(names, codes, strict=True) if code not in _FORMS]
    wanted = "".join(code for _, code in arrays)
    given = (
        _HANDED.get(code, "*{0}.buffer_info()").format(name) for name, code in zip(names, codes, strict=True)
    )
    count = len({name.partition("[")[0] for name in names})
    source = (
        f"def call({', '.join(f'a{i}' for i in range(count))}):\n"
        f"    found = ({''.join(f'{name}.typecode, ' for name, _ in arrays)})\n"
        f"    if found != codes: refuse(wanted, ({''.join(f'{name}, ' for name, _ in arrays)}))\n"
        f"    return entry(pack({', '.join(given)}))\n"
    )
    scope = {
        "entry": entry, "pack": pack, "addressof": addressof, "place_of": place_of, "codes": tuple(wanted),
        "wanted": wanted, "refuse": _refuse,
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


def _refuse(wanted: str, found: Iterable[array[Any]]) -> None:
    msg = f"a kernel was given arrays of {''.join(map(_typecode, found))}, not of {wanted}"
    raise TypeError(msg)

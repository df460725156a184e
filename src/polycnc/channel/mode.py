"""Modal state as immutable, interned values.

A `Mode` names the active code of every modal group. Changing a group is a transition to another `Mode`; each mode and
each transition exists once. Whatever can be worked out from a modal state alone (how a block of some shape acts in it)
is therefore worked out once and kept on the mode, in `plans`.
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping


class Mode:
    """The active code of every modal group, as an interned value. Compare modes with `is`."""

    __slots__ = ("__getitem__", "_table", "_transitions", "codes", "plans")

    def __init__(self, table: ModeTable, codes: dict[str, str]) -> None:
        self._table = table
        self._transitions: dict[tuple[str, str], Mode] = {}
        self.codes = codes
        # `mode["plane"]` is the mapping's own method, without a step in between: every plan asks many times.
        self.__getitem__ = codes.__getitem__  # type: ignore[method-assign]  # a slot
        self.plans: dict[Any, Any] = {}

    if TYPE_CHECKING:

        def __getitem__(self, group: str) -> str:
            """The active code of a group."""

    def with_code(self, group: str, code: str) -> Mode:
        """The mode that differs in one group."""
        mode = self._transitions.get((group, code))
        if mode is None:
            mode = self._transitions[group, code] = self._table.mode({**self.codes, group: code})
        return mode

    def with_codes(self, changes: Iterable[tuple[str, str]]) -> Mode:
        """The mode after several changes, in order."""
        mode = self
        for group, code in changes:
            mode = mode.with_code(group, code)
        return mode

    def __repr__(self) -> str:
        return "Mode(" + " ".join(self.codes.values()) + ")"


class ModeTable:
    """All modes of one channel."""

    def __init__(self) -> None:
        #: Changes when plans made before no longer hold.
        self.generation = 0
        self._modes: dict[tuple[tuple[str, str], ...], Mode] = {}

    def mode(self, codes: Mapping[str, str]) -> Mode:
        """The one mode with these codes."""
        key = tuple(sorted(codes.items()))
        mode = self._modes.get(key)
        if mode is None:
            mode = self._modes[key] = Mode(self, dict(codes))
        return mode

    def forget_plans(self) -> None:
        """Called when something beside the modal state that plans rest on has changed (a parameter)."""
        self.generation += 1
        for mode in self._modes.values():
            mode.plans.clear()

    def memento(self) -> Callable[[], None]:
        """For a snapshot: modes and plans are only worked out once, but plans that rest on what was changed are none.

        The generation never goes back: nobody must take a plan made in between for one of before.
        """
        generation = self.generation

        def put_back() -> None:
            if self.generation != generation:
                self.forget_plans()

        return put_back

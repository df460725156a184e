"""What acts on a block beside its own codes and words, as a tuple that can be read.

A control declares its `rules` in the order in which they act. Each is an object of the module whose feature it belongs
to, and says what makes it concern a block, so that it is not asked of any other. A rule whose function is switched off
rests; that is asked once for each modal state. The others are asked once for each shape of block in each modal state,
when its plan is made:

1. `check`, then `replace`, rule by rule: what a block must not hold, and a call that takes the whole block.
2. `before`: a step in front of everything else that the block does.
3. `motion`: the step of the axis words, unless a one-shot code takes them; the first rule that has one decides. Where
   none has, the active motion code does. `corner` and `convert` are asked by the planners of motion and of axis words.
4. `wrap`: the step of the motion again, each rule round what the rules in front of it have made of it.
5. `after`: a step behind the motion and behind the codes that act there, in front of M codes that act last.
6. `last`: a step behind everything: a program that the block calls begins when all of the block is done.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping

from polycnc.deferred.records import dataclass, field
from polycnc.deferred.typing import TYPE_CHECKING

if TYPE_CHECKING:
    from polycnc.channel.channel import Channel
    from polycnc.channel.intervention import TakesBack
    from polycnc.control.word_address.block.codes import Planner, Step
    from polycnc.control.word_address.block.numbers import Convert
    from polycnc.control.word_address.block.plan import AxisWord, Builder, Plan

#: The group of drilling cycles, and its code while none is active.
CYCLE, NO_CYCLE = "cycle", "G80"


@dataclass(frozen=True, slots=True)
class Rule:
    """Something that acts on blocks.

    What makes it concern a block; any one of them does, and a rule that names none concerns every block.

    Attributes:
        modes: Modal groups, each with codes of which one holds in front of the block or in it.
        within: The same, of which one holds in the block.
        unless: Modal groups, each with the code at which the rule rests.
        codes: G codes of the block.
        groups: Groups of its G codes.
        words: Addresses of the block.
        m_codes: Any M code.
        where: What else makes it concern a block.

    What it must be besides.

    Attributes:
        in_cycles: The rule acts also while a drilling cycle is active.
        rests: Whether the function is switched off on a channel: by parameters, by the machine, by a state whose
            change forgets the plans.

    What it does; the head of the module says when.

    Attributes:
        check: Raises the alarm for what the block must not hold.
        replace: The step that stands in place of the whole block.
        before: A step in front.
        addresses: Words of the block that mean something else than usual, each with what plans it; None where the step
            of the axis words takes it.
        axis_words: Axis words beside those whose addresses name axes.
        takes_back: What the block takes back of a manual intervention.
        motion: The step of the axis words; it may refuse them, or take other words, and leave them to the next rule.
        corner: What goes between this move and the next one.
        convert: What turns a word of an axis (by its form, and by what would do it otherwise) into internal units.
        wrap: What becomes of the motion's step, None where there is no motion.
        after: A step behind.
        last: A step behind everything.
    """

    name: str
    modes: Mapping[str, Collection[str]] = field(default_factory=dict)
    within: Mapping[str, Collection[str]] = field(default_factory=dict)
    unless: Mapping[str, str] = field(default_factory=dict)
    codes: Collection[str] = ()
    groups: Collection[str] = ()
    words: Collection[str] = ()
    m_codes: bool = False
    where: Callable[[Builder], bool] | None = None
    in_cycles: bool = True
    rests: Callable[[Channel], bool] | None = None
    check: Callable[[Builder], None] | None = None
    replace: Callable[[Builder, Plan], Step | None] | None = None
    before: Callable[[Builder, Plan], Step | None] | None = None
    addresses: Mapping[str, Planner | None] = field(default_factory=dict)
    axis_words: Callable[[Builder], Collection[AxisWord]] | None = None
    takes_back: Callable[[Builder, Plan], TakesBack | None] | None = None
    motion: Callable[[Builder, Plan], Step | None] | None = None
    corner: Callable[[Builder], Step | None] | None = None
    convert: Callable[[Builder, int, str, Convert | None], Convert | None] | None = None
    wrap: Callable[[Builder, Plan, Step | None], Step | None] | None = None
    after: Callable[[Builder, Plan], Step | None] | None = None
    last: Callable[[Builder, Plan], Step | None] | None = None

    _asks_modes: bool = field(init=False, repr=False, compare=False)
    _asks_words: bool = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        asks_words = bool(self.codes or self.groups or self.words or self.m_codes or self.where)
        object.__setattr__(self, "_asks_modes", bool(self.modes or self.within or self.unless))
        object.__setattr__(self, "_asks_words", asks_words)

    def concerns(self, builder: Builder) -> bool:
        """Whether the rule is asked of a block."""
        before, after = builder.before.codes, builder.mode.codes
        concerns = self.concerns_by_mode(before, after)
        return concerns or (concerns is None and self.concerns_by_words(builder))

    def concerns_by_mode(self, before: Mapping[str, str], after: Mapping[str, str]) -> bool | None:
        """Whether the rule is asked of every block between two modal states; None where its words decide."""
        if not self.in_cycles and after.get(CYCLE, NO_CYCLE) != NO_CYCLE:
            return False
        if self._asks_modes and self._holds(before, after):
            return True
        return None if self._asks_words else not self._asks_modes

    def _holds(self, before: Mapping[str, str], after: Mapping[str, str]) -> bool:
        if any(after.get(group) in chosen for group, chosen in self.within.items()):
            return True
        for codes in (before,) if after is before else (before, after):
            for group, chosen in self.modes.items():
                if codes.get(group) in chosen:
                    return True
            for group, rests in self.unless.items():
                if codes.get(group, rests) != rests:
                    return True
        return False

    def concerns_by_words(self, builder: Builder) -> bool:
        """Whether the codes and words of a block make the rule concern it."""
        if self.codes or self.groups:
            for row in builder.codes:
                if row.code in self.codes or row.group in self.groups:
                    return True
        if (self.m_codes and builder.m_codes) or not builder.slots.keys().isdisjoint(self.words):
            return True
        return self.where is not None and self.where(builder)

"""What is known of the shapes of blocks, in the kernels' tables: the tree of shapes, and the rule of each."""

from __future__ import annotations

from array import array

from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import layout
from polycnc.language.bulk.recipe import AS_TYPED, Arc, Call, Return, Straight, Word

if TYPE_CHECKING:
    from collections.abc import Hashable, Sequence

    from polycnc.language.bulk.recipe import Note, Recipe, Step, Target

_NO_WORD = Word(-1, AS_TYPED)
#: More shapes than this are no longer learnt.
MOST_NODES = 5_000


class Shapes:
    """The tree of shapes, with a root for every modal state.

    Attributes:
        nexts: Flat `(nodes, KEY_COUNT)`: the node behind a key, 0 for none.
        leaves: For each node the number of its rule, or what is known instead.
        rules: Flat `(rules, Rule.SIZE)`.
        factors: Flat `(rules, Factor.SIZE)`.
        formulas: What rules calculate; the first one is none.
        states: Modal states by the number of their root.
        notes: By the number of a rule, the steps that its blocks leave to the interpreter.
        assigns: Whether blocks of any rule give a variable a value.
        calls: Whether blocks of any rule call a program.
    """

    def __init__(self) -> None:
        self.nexts = array("i", bytes(4 * layout.KEY_COUNT))
        self.leaves = array("i", [layout.Leaf.UNKNOWN])
        self.rules = array("i", bytes(4 * layout.Rule.SIZE * layout.Leaf.FIRST_RULE))
        self.factors = array("d", bytes(8 * layout.Factor.SIZE * layout.Leaf.FIRST_RULE))
        self.formulas = array("i", (layout.Operation.END, 0))
        self.states: dict[int, Hashable] = {}
        self.notes: dict[int, tuple[tuple[Step, Note], ...]] = {}
        self.assigns = self.calls = False
        self._roots: dict[Hashable, int] = {}

    def root(self, state: Hashable) -> int:
        """The node from which shapes start in a modal state."""
        node = self._roots.get(state)
        if node is None:
            node = self._roots[state] = self._new_node()
            self.states[node] = state
        return node

    def learn(self, root: int, keys: Sequence[int], recipe: Recipe | None) -> bool:
        """Keep what a shape does, None for one that is not plain; true if its blocks can be scanned from now on."""
        if len(self.leaves) > MOST_NODES:
            return False
        node = root
        for key in keys:
            place = node * layout.KEY_COUNT + key
            if not self.nexts[place]:
                self.nexts[place] = self._new_node()
            node = self.nexts[place]
        self.leaves[node] = layout.Leaf.NOT_PLAIN if recipe is None else self._add_rule(recipe)
        return recipe is not None

    def _new_node(self) -> int:
        self.leaves.append(layout.Leaf.UNKNOWN)
        self.nexts.frombytes(bytes(self.nexts.itemsize * layout.KEY_COUNT))
        return len(self.leaves) - 1

    def _add_rule(self, recipe: Recipe) -> int:
        rule = array("i", bytes(4 * layout.Rule.SIZE))
        factors = array("d", bytes(8 * layout.Factor.SIZE))
        rule[layout.Rule.NEXT_STATE] = self.root(recipe.next_state)
        _put_word(rule, factors, layout.Rule.FEED_WORD, recipe.feed.word if recipe.feed else None)
        rule[layout.Rule.POSITIVE_FEED] = recipe.feed is not None and recipe.feed.positive
        _put_notes(rule, factors, recipe.notes)
        if recipe.formulas:
            rule[layout.Rule.FORMULAS] = self.add_formulas(recipe.formulas)
            self.assigns = self.assigns or layout.Operation.ASSIGN in recipe.formulas[::2]
        if isinstance(recipe.motion, Straight):
            _put_straight(rule, recipe.motion)
        elif isinstance(recipe.motion, Arc):
            _put_arc(rule, factors, recipe.motion)
        elif isinstance(recipe.motion, Call):
            _put_call(rule, factors, recipe.motion)
            self.calls = True
        elif isinstance(recipe.motion, Return):
            rule[layout.Rule.FLOW] = layout.Flow.RETURN
        for i, target in enumerate(_targets(recipe)):
            place = layout.Rule.FIRST_TARGET + layout.TARGET_WIDTH * i
            _put_word(rule, factors, place, Word(target.slot, target.conversion))
            rule[place + 2], rule[place + 3] = target.axis, target.incremental
            rule[layout.Rule.TARGETS] = i + 1
        self.rules.extend(rule)
        self.factors.extend(factors)
        number = len(self.rules) // layout.Rule.SIZE - 1
        self.notes[number] = recipe.notes
        return number

    def add_formulas(self, formulas: Sequence[int]) -> int:
        """Keep what is calculated; gives where it begins."""
        place = len(self.formulas)
        self.formulas.extend((*formulas, layout.Operation.END, 0))
        return place

    @property
    def calculates(self) -> bool:
        """Whether any rule has formulas."""
        return len(self.formulas) > 2

    def state_behind(self, rule: int) -> Hashable:
        """The modal state that blocks of a rule leave."""
        return self.states[self.rules[rule * layout.Rule.SIZE + layout.Rule.NEXT_STATE]]


def _targets(recipe: Recipe) -> Sequence[Target]:
    """Axis words of a recipe, or arguments."""
    if isinstance(recipe.motion, (Straight, Arc)):
        return recipe.motion.targets
    return (recipe.motion.arguments or ()) if isinstance(recipe.motion, Call) else ()


def _put_word(rule: array[int], factors: array[float], place: int, word: Word | None) -> None:
    slot, (way, scale, unit) = word or _NO_WORD
    rule[place], rule[place + 1] = slot, way
    factors[place], factors[place + 1] = scale, unit


def _put_notes(rule: array[int], factors: array[float], notes: Sequence[tuple[Step, Note]]) -> None:
    rule[layout.Rule.LEAVES_NOTE], rule[layout.Rule.NOTE_WORD] = bool(notes), -1
    for _, note in notes:
        if note.slot >= 0:
            rule[layout.Rule.NOTE_WORD] = note.slot
            factors[layout.Factor.LOWEST_NOTE] = note.lowest


def _put_call(rule: array[int], factors: array[float], call: Call) -> None:
    rule[layout.Rule.FLOW] = layout.Flow.SUBPROGRAM if call.arguments is None else layout.Flow.MACRO
    _put_word(rule, factors, layout.Rule.CALLED, call.number)
    _put_word(rule, factors, layout.Rule.REPEATS, call.repeats)


def _put_straight(rule: array[int], motion: Straight) -> None:
    rule[layout.Rule.MOTION] = layout.Motion.RAPID if motion.rapid else layout.Motion.FEED
    rule[layout.Rule.NEEDS_FEED] = motion.needs_feed and not motion.rapid
    rule[layout.Rule.NAMES_FEED] = motion.names_feed
    rule[layout.Rule.ABSOLUTE] = motion.absolute
    rule[layout.Rule.SKIPS_TINY] = motion.skips_tiny
    rule[layout.Rule.DRILLS] = motion.drills + 1
    rule[layout.Rule.HAS_DIRECTION] = motion.direction is not None
    for i, slot in enumerate(motion.direction or ()):
        rule[layout.Rule.DIRECTION + i] = slot


def _put_arc(rule: array[int], factors: array[float], motion: Arc) -> None:
    rule[layout.Rule.MOTION] = layout.Motion.ARC
    rule[layout.Rule.NEEDS_FEED] = motion.needs_feed
    rule[layout.Rule.CCW] = motion.ccw
    rule[layout.Rule.LINE_WITHOUT_WAY] = motion.line_without_way
    for i, axis in enumerate(motion.plane):
        rule[layout.Rule.PLANE + i] = axis
    _put_word(rule, factors, layout.Rule.FIRST_CENTER, motion.centers[0])
    _put_word(rule, factors, layout.Rule.SECOND_CENTER, motion.centers[1])
    _put_word(rule, factors, layout.Rule.RADIUS, motion.radius)
    factors[layout.Factor.RADIUS_TOLERANCES] = motion.radius_tolerances

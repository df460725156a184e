"""Plans: what a block of some shape does in some modal state.

The first block of a shape (its *signature*, see `language.word_address.words`) is checked whole against the control's
tables: every code known and executed, every word taken by somebody. The outcome is a `Plan`: the modal state that the
block leaves and the steps that it takes, in the order in which the control works a block off. Plans are kept on the
modal state; later blocks of the same shape only bring new numbers.
"""

from __future__ import annotations

from polycnc.channel.intervention import NOTHING_BACK, TakesBack
from polycnc.control.word_address.block.codes import GCode, MCode, Order, Step
from polycnc.control.word_address.block.numbers import Convert, NumberRules, length_converter
from polycnc.control.word_address.block.words import Words
from polycnc.control.word_address.memory import SentCodes
from polycnc.control.word_address.motion.path_modes import end_of_exact_stop, exact_stop_block
from polycnc.deferred.functions import Deferred
from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.records import dataclass
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk import Idle, Later, Note, declare, declared
from polycnc.language.word_address.words import FORMS, is_fixed_code
from polycnc.messages import AlarmError
from polycnc.toolpath.events import Auxiliary

if TYPE_CHECKING:
    from collections.abc import Callable, Collection, Iterable, Iterator, Mapping

    from polycnc.channel.channel import Channel
    from polycnc.channel.mode import Mode
    from polycnc.control.word_address.block.codes import Handler, MotionPlanner, Planner
    from polycnc.control.word_address.block.rules import Rule
    from polycnc.control.word_address.control import WordAddressControl
    from polycnc.control.word_address.cycles.drilling import Drilling
    from polycnc.language.bulk import Condition

#: The alarm of a code that a control knows and polycnc does not execute yet, on every control.
NOT_YET = "PC0001"
#: The group of one-shot codes that use up the axis words (00).
ONE_SHOT = "one-shot"


@dataclass(frozen=True, slots=True)
class AxisWord:
    """An axis word of a shape: which axis, which value, how it converts, absolute or incremental."""

    address: str
    axis: int
    slot: int
    convert: Convert | None
    incremental: bool


class Footing:
    """What the blocks of a modal state rest on, beside the modes themselves; like plans it is kept on the mode.

    Attributes:
        g_codes: The G table as programs write it now.
        diameters: Whether words of each axis are diameters.
        in_force: The control's rules that do not rest.
        steady: Those that may concern a block that leaves the modes as they are, and whether they do in any case.
        planners: What plans the axis words of each motion code.
        rules: How numbers are read.
        cycles: How the control drills.
    """

    __slots__ = ("cycles", "diameters", "g_codes", "in_force", "planners", "rules", "steady")

    def __init__(self, channel: Channel, control: WordAddressControl) -> None:
        self.g_codes: Mapping[str, GCode] = control.g_table(channel)
        rows = (*control.g_codes.values(), *self.g_codes.values())
        self.planners: dict[str, MotionPlanner | None] = {
            row.code: row.planner for row in rows if row.group == "motion"
        }
        self.rules: NumberRules = control.number_rules(channel)
        self.cycles: Drilling = control.drilling_rules(channel)
        self.diameters = tuple(control.is_diameter(channel, axis) for axis in range(len(channel.axes)))
        self.in_force = tuple(rule for rule in control.rules if rule.rests is None or not rule.rests(channel))
        codes = channel.mode.codes
        asked = ((rule, rule.concerns_by_mode(codes, codes)) for rule in self.in_force)
        self.steady = tuple((rule, bool(concerns)) for rule, concerns in asked if concerns is not False)

    @classmethod
    def of(cls, channel: Channel, control: WordAddressControl) -> Footing:
        """The footing of the present modal state."""
        plans = channel.mode.plans
        footing = plans.get(cls)
        if footing is None:
            footing = plans[cls] = cls(channel, control)
        return footing


class Arguments(NamedTuple):
    """Which words of a block set which local variables of a macro.

    Attributes:
        typed: Variable, place of the value, and what converts it.
        fixed: Variable and value, of codes.
    """

    typed: tuple[tuple[int, int, Convert | None], ...]
    fixed: tuple[tuple[int, float], ...]


class Plan:
    """What the blocks of one shape do in one modal state.

    `order` are its codes and addresses in the order typed, `keys` the same as a set. `program_name` is what `<NAME>` in
    them calls, `rest` the words that go to the machine with a code of its builder, `arguments` how a macro call takes
    the words.
    """

    __slots__ = (
        "arguments", "axis_words", "control", "inch", "keys", "m_codes", "m_words", "mode", "order", "program_name",
        "rest", "rules", "slots", "steps", "takes_back", "typed",
    )  # fmt: skip

    def __init__(self, builder: Builder) -> None:
        self.control = builder.control
        self.mode = builder.mode
        self.slots = builder.slots
        self.typed = builder.typed
        self.order = builder.order
        self.keys = frozenset(builder.order)
        self.m_codes, self.m_words = builder.m_codes, builder.m_words
        self.program_name = builder.program_name
        self.rest: tuple[str, ...] = ()
        self.rules: NumberRules = builder.rules
        self.inch = builder.inch
        self.axis_words: tuple[AxisWord, ...] = ()
        self.steps: tuple[Step, ...] = ()
        self.takes_back = NOTHING_BACK
        self.arguments: dict[tuple[str, int | None], Arguments] = {}

    def without(self, addresses: Collection[str]) -> Plan:
        """The same plan for a code to which some words of the block do not belong."""
        from copy import copy

        plan = copy(self)
        plan.arguments = {}
        plan.slots = {address: slot for address, slot in self.slots.items() if address not in addresses}
        plan.typed = [word for word in self.typed if word[0] not in addresses]
        plan.axis_words = tuple(word for word in self.axis_words if word.address not in addresses)
        return plan

    def run(self, channel: Channel, values: list[float]) -> None:
        """Run one block."""
        channel.mode = self.mode
        channel.takes_back = self.takes_back
        for step in self.steps:
            step(channel, values)


class Builder:
    """Works out one plan.

    Attributes:
        before: Modal state before the block.
        mode: Modal state that the block brings.
        slots: Address to (index of its value, how it was written); of a repeated address the last one counts.
        typed: All words in the order typed, repeated ones included: (address, index, how written).
        m_codes: Numbers of its M codes in the order typed; `m_words` as they are written, for a macro.
        codes: Rows of the block's G codes in the order typed; of one group only the last.
        acting: The control's rules that concern the block, in their order.
    """

    def __init__(self, channel: Channel, control: WordAddressControl, signature: tuple[str, ...]) -> None:
        self.channel = channel
        self.control = control
        self.signature = signature
        self.before: Mode = channel.mode
        self.footing = Footing.of(channel, control)
        self.rules = self.footing.rules
        self.slots: dict[str, tuple[int, str]] = {}
        self.typed: list[tuple[str, int, str]] = []
        self.order: list[str] = []
        self.codes: list[GCode] = []
        self.m_codes: list[int] = []
        self.m_words: list[float] = []
        self.program_name = ""
        self._taken: set[str] = set()
        self._is_open = False
        self._read_signature()
        self.mode = self.before.with_codes(control.modal_changes(self.codes))
        self._drop_idle_codes()
        self.inch = control.is_inch(self.mode)
        self.acting: tuple[Rule, ...] = tuple(self._concerned())

    def _concerned(self) -> Iterator[Rule]:
        if self.mode.codes is self.before.codes:
            return (
                rule for rule, concerns in self.footing.steady if concerns or rule.concerns_by_words(self)
            )
        return (rule for rule in self.footing.in_force if rule.concerns(self))

    def _read_signature(self) -> None:
        position = 0
        by_group: dict[str, GCode] = {}
        for key in self.signature:
            if key[0] == "<":
                self.program_name = key[1:-1]
                continue
            if is_fixed_code(key):
                if key[0] == "M":
                    self.m_words.append(float(key[1:]))
                    self.m_codes.append(int(self.m_words[-1]))
                    self.order.append(f"M{self.m_codes[-1]}")
                else:
                    self.order.append(key)
                    row = self._row(key)
                    group = row.group or (ONE_SHOT if self._moves_once(row) else row.code)
                    by_group.pop(group, None)
                    by_group[group] = row
                continue
            address = key.rstrip(FORMS)
            form = key[len(address) :]
            self.typed.append((address, position, form))
            self.slots[address] = (position, form)
            self.order.append(address)
            position += 1
        self.codes = list(by_group.values())

    @staticmethod
    def _moves_once(row: GCode) -> bool:
        """Whether a one-shot code (group 00) uses up the axis words: of several such codes the last one counts.

        A call of a macro (`*`) hands over what stands behind it; it has words of its own.
        """
        return row.axis_words and "*" not in row.addresses

    def _drop_idle_codes(self) -> None:
        """Leave out codes that have no effect while a drilling cycle is active; their words are theirs."""
        idle = [row for row in self.codes if row.idle_in_cycle]
        if idle and self.drills:
            for row in idle:
                self.take(*row.addresses)
            self.codes = [row for row in self.codes if not row.idle_in_cycle]
            self.mode = self.before.with_codes(self.control.modal_changes(self.codes))

    def _row(self, code: str) -> GCode:
        row = self.footing.g_codes.get(code)
        if row is None:
            raise self.control.unknown_code(code)
        if row.not_yet:
            raise AlarmError(NOT_YET, address=code, hint="hint.not-supported", code=code)
        return row

    # ---- what planners and handlers of the table ask ---------------------------------------------------------------

    def has(self, address: str) -> bool:
        """Whether the block holds a word."""
        return address in self.slots

    def take(self, *addresses: str) -> None:
        """Somebody deals with these addresses."""
        self._taken.update(addresses)

    def is_free(self, address: str) -> bool:
        """Whether nobody deals with an address yet."""
        return address not in self._taken and "*" not in self._taken

    def slot(self, address: str) -> int | None:
        """Index of a word's value, or None."""
        slot = self.slots.get(address)
        return None if slot is None else slot[0]

    def length(self, address: str, *, diameter: bool = False) -> Convert | None:
        """Converter of a length word that the block holds."""
        return length_converter(self.slots[address][1], self.rules, inch=self.inch, diameter=diameter)

    def handled(self, handler: Handler, plan: Plan) -> Step:
        """A step that calls a handler with the block's words; it says what the handler says of its plans."""

        def step(channel: Channel, values: list[float]) -> None:
            handler(channel, Words(plan, values))

        if isinstance(handler, Deferred):  # its module need not be there before somebody asks
            return declare(step, Later(lambda: _told(handler, plan)))
        return step if declared(handler) is None else declare(step, Later(lambda: _told(handler, plan)))

    @property
    def drills(self) -> bool:
        """Whether a drilling cycle is active in the block."""
        return self.mode.codes.get("cycle", "") in self.footing.cycles.cycles

    def corner(self) -> Step | None:
        """What chamfer and corner words of the block ask for; None without them."""
        for rule in self.acting:
            if rule.corner is not None and (step := rule.corner(self)) is not None:
                return step
        return None

    def axis_converter(self, axis: int, form: str) -> Convert | None:
        """What turns a word of an axis, written so, into internal units."""
        convert = self.control.axis_converter(self, axis, form)
        for rule in self.acting:
            if rule.convert is not None:
                convert = rule.convert(self, axis, form, convert)
        return convert

    def _in_force(self, row: GCode) -> bool:
        return bool(row.group) and self.before.codes.get(row.group) == row.code

    def _is_repeated(self, row: GCode) -> bool:
        """Whether a code that only changes something is in force already; its words are its own all the same."""
        if not row.only_changes or not self._in_force(row):
            return False
        self.take(*row.addresses)
        return True

    def words_of(self, row: GCode, plan: Plan) -> Plan:
        """The plan as a code sees it: words of a macro call beside it are arguments, others may be another code's."""
        if any("*" in other.addresses for other in self.codes if other is not row):
            return plan.without(self.slots)
        others = self._given_away(row)
        return plan.without(others) if others else plan

    def _given_away(self, row: GCode) -> list[str]:
        """Words of the block that a code would take and another code takes."""
        return [a for a in row.gives_way if self.has(a) and self._is_claimed(a, row)]

    def _is_claimed(self, address: str, row: GCode) -> bool:
        """Whether another code of the block than this one takes an address."""
        by_g = any(address in other.addresses for other in self.codes if other is not row)
        by_m = any(address in self.control.m_row(self, number).takes.split() for number in self.m_codes)
        drills = any(other.group == "cycle" for other in self.codes) and self.drills
        return by_g or by_m or (drills and address in self.footing.cycles.words)

    def _acted(self, row: GCode, handler: Handler, plan: Plan) -> Step:
        """The step of a code's handler; it says so where it only tells the context, or may change nothing."""
        step, control = self.handled(handler, self.words_of(row, plan)), self.control
        if any(self.has(address) for address in row.addresses):
            return step
        if any(handler is each for each in control.only_context):
            return declare(step, Note())
        if self._in_force(row) and row.code in control.repeated_codes:
            return _unless_repeated(step, control.repeated_codes[row.code])
        return step

    def axis_words(self) -> tuple[AxisWord, ...]:
        """The axis words of the block; they count as taken."""
        words: list[AxisWord] = []
        channel, control = self.channel, self.control
        for address, (position, form) in self.slots.items():
            target = control.axis_of_address(channel, address, self)
            if target is None:
                continue
            index, incremental = target
            convert = self.axis_converter(index, form)
            words.append(AxisWord(address, index, position, convert, incremental))
            self.take(address)
        if control.LATER_AXIS_WORD_COUNTS:
            words = list({word.axis: word for word in words}.values())
        for rule in self.acting:
            if rule.axis_words is not None:
                words += rule.axis_words(self)
        return tuple(words)

    # ---- the plan ---------------------------------------------------------------------------------------------------

    def build(self) -> Plan:
        """The plan; raises the control's alarm for what the block must not hold."""
        plan = Plan(self)
        whole = self.replacement(plan)
        if whole is not None:
            plan.mode = self.before
            plan.steps = (whole,)
            return plan
        rows = sorted((row for row in self.codes if not self._is_repeated(row)), key=lambda row: row.order)
        for row in rows:
            others = self._given_away(row)
            self.take(*(address for address in row.addresses if address not in others))
        plan.axis_words = self.axis_words()
        plan.takes_back = self._takes_back(plan)
        before, after = self._auxiliary_steps(plan)
        front = [rule.before(self, plan) for rule in self.acting if rule.before is not None]
        steps = [
            *(step for step in front if step is not None),
            *before,
            *(self._acted(r, r.handler, plan) for r in rows if r.handler and r.order < Order.MOTION),
        ]
        if not any(row.axis_words for row in rows):
            motion = self._motion_step(plan)
            if motion is not None:
                steps.append(motion)
        behind_motion = [row for row in rows if row.handler and row.order >= Order.MOTION]
        steps += [self.handled(r.handler, self.words_of(r, plan)) for r in behind_motion if r.handler]
        if any(row.handler is exact_stop_block for row in rows):
            steps.append(end_of_exact_stop)
        behind = [rule.after(self, plan) for rule in self.acting if rule.after is not None]
        last = [rule.last(self, plan) for rule in self.acting if rule.last is not None]
        steps += [*(step for step in behind if step is not None), *after]
        plan.steps = (*steps, *(step for step in last if step is not None))
        untaken = self._untaken()
        if untaken and not (self._is_open or any(row.open for row in rows)):
            raise self.control.untaken(untaken[0], self)
        plan.rest = untaken
        return plan

    def replacement(self, plan: Plan) -> Step | None:
        """The step of a rule that takes the whole block; raises what a rule refuses in front of it."""
        for rule in self.acting:
            if rule.check is not None:
                rule.check(self)
            if rule.replace is not None and (step := rule.replace(self, plan)) is not None:
                return step
        return None

    def _takes_back(self, plan: Plan) -> TakesBack:
        """What the block takes back of a manual intervention: axes named absolutely, where no rule says else."""
        for rule in self.acting:
            if rule.takes_back is not None and (back := rule.takes_back(self, plan)) is not None:
                return back
        return TakesBack(sum(1 << axis for axis in {w.axis for w in plan.axis_words if not w.incremental}))

    def _motion_step(self, plan: Plan) -> Step | None:
        """The step of the axis words: of the first rule that has one, or of the active motion code; then wrapped."""
        step: Step | None = None
        for rule in self.acting:
            if rule.motion is not None and (step := rule.motion(self, plan)) is not None:
                break
        else:
            planner = self.footing.planners.get(self.mode["motion"])
            step = planner(self, plan) if planner is not None else None
        for rule in self.acting:
            if rule.wrap is not None:
                step = rule.wrap(self, plan, step)
        return step

    def _auxiliary_steps(self, plan: Plan) -> tuple[list[Step], list[Step]]:
        """Steps of F, S, T, D and the like and of M codes: those with the motion in the order typed, those after."""
        before: list[Step] = []
        after: list[Step] = []
        if "*" in self._taken:
            return before, after
        m_rows = {
            key: self.control.m_row(self, int(float(key[1:])))
            for key in self.order
            if key[0] == "M" and is_fixed_code(key)
        }
        meanings: dict[str, Planner | None] = dict(self.control.addresses)
        for rule in self.acting:
            meanings.update(rule.addresses)
        for row in m_rows.values():
            self.take(*row.takes.split())
            self._is_open = self._is_open or row.open
        for key in self.order:
            if key in self._taken and key in self.slots:
                continue
            if key in m_rows:
                row = m_rows[key]
                speed_follows = not row.after and "S" in self.order[self.order.index(key) :]
                act = _m_step(row, self, plan, speed_follows=speed_follows)
                (after if row.after else before).append(act)
                continue
            planner = meanings.get(key)
            if planner is not None:
                step = self.control.guarded_word(self, key, planner(self))
                self.take(key)
                if step is not None:
                    before.append(step)
        return before, after

    def _untaken(self) -> tuple[str, ...]:
        """The addresses that nothing in the block takes."""
        if "*" in self._taken:
            return ()
        return tuple(address for address in self.slots if address not in self._taken)


def _m_step(row: MCode, builder: Builder, plan: Plan, *, speed_follows: bool) -> Step:
    """The step of an M code; `speed_follows`: an S of its block comes behind it.

    A spindle turns otherwise from the code's own event on, whatever the next block says. With an S behind it, it goes
    to both at once; under constant surface speed the next move says to which speed.
    """
    handler = builder.handled(row.handler, plan) if row.handler else None
    if row.silent:
        return handler or _nothing
    code, takes = row.code, tuple(filter(builder.has, row.takes.split()))
    spindle = builder.control.spindle_slot(builder)
    plain = Auxiliary(code)
    is_first = row.turns and not speed_follows and builder.mode.codes.get("surface_speed") != "G96"

    def act(channel: Channel, values: list[float]) -> None:
        if is_first and handler is not None:
            handler(channel, values)
        sent = (*takes, *plan.rest) if row.open else takes
        if spindle is None and not sent:
            channel.event(plain)
        else:
            number = None if spindle is None else int(values[spindle])
            channel.event(Auxiliary(code, number, sent_words(plan, sent, values) if sent else None))
        SentCodes.of(channel).m = code
        if not is_first and handler is not None:
            handler(channel, values)

    is_alone = spindle is None and not takes and not builder.drills
    if is_alone and _only_notes(row.handler, plan):
        note = Note(apart=builder.channel.machine.goes_beside(code))
        return declare(act, Later(lambda: None if row.open and plan.rest else note))
    return act


def _only_notes(handler: Handler | None, plan: Plan) -> bool:
    """Whether the handler of an M code does nothing, or nothing with which the scanner works."""
    return handler is None or (not isinstance(handler, Deferred) and isinstance(_told(handler, plan), Note))


def _told(handler: Handler, plan: Plan) -> object:
    """What a handler says that a plan does; None for nothing."""
    tell: Callable[[Plan], object] | None = declared(handler)  # type: ignore[assignment]
    return None if tell is None else tell(plan)


def _nothing(_channel: Channel, _values: list[float]) -> None:
    """An M code that only exists."""


def _unless_repeated(step: Step, changes_nothing: Condition) -> Step:
    """The step of a code in force already, which rests where it would change nothing: for the scanner as here."""

    def act(channel: Channel, values: list[float]) -> None:
        if not changes_nothing(channel):
            step(channel, values)

    return declare(act, Idle(changes_nothing))


def sent_words(plan: Plan, addresses: Iterable[str], values: list[float]) -> dict[str, float]:
    """Words of a block that go to the machine, as they are typed."""
    return {address: values[plan.slots[address][0]] for address in addresses}

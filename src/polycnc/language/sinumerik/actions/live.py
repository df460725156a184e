"""Expressions and effects of actions: main-run variables are read in every cycle, all else where the block is prepared.

The reader writes code for the main run. An operand that belongs to preparation (`R5`, `$MA_…`, a user variable, a
function of these) is compiled for the block itself, which works its value out once; in the code of the main run a place
in the tuple of these values stands for it (10.1.2).
"""

from __future__ import annotations

from polycnc.deferred.typing import TYPE_CHECKING, Any
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, call, constant, given, item, name, quoted, sequence
from polycnc.language.expressions.shapes import Function, TooDeepError
from polycnc.language.sinumerik import keywords
from polycnc.language.sinumerik.actions.code import UNITS, Needs
from polycnc.language.sinumerik.emitter import Emitter
from polycnc.language.sinumerik.errors import NcSyntaxError
from polycnc.language.sinumerik.expressions import Expr, ExpressionReader
from polycnc.language.sinumerik.names.places import RPlace, SystemPlace
from polycnc.language.sinumerik.names.values import Axis, Type

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from polycnc.language.expressions.code import Body
    from polycnc.language.sinumerik.actions.code import Condition, Effect
    from polycnc.language.sinumerik.lexer import Token
    from polycnc.language.sinumerik.names.places import Place
    from polycnc.language.sinumerik.names.variables import Variable

PARAMETERS = ("channel", "frozen", "own", "acting")
_FROZEN, _OWN, _ACTING = name("frozen"), name("own"), name("acting")
#: Functions that are worked out in the main run.
LIVE_FUNCTIONS = frozenset(
    {
        "POSRANGE", "CTAB", "CTABINV", "CTABTSV", "CTABTEV", "CTABTSP", "CTABTEP", "CTABSSV", "CTABSEV", "CTABTMIN",
        "CTABTMAX",
    }
)  # fmt: skip
#: Words with an axis or spindle in brackets, and those that may do without.
AXIS_WORDS = frozenset({"POS", "MOV", "FA", "FXS", "FXST", "FXSW", "FOCON", "FOCOF", "MEAWA", "MEAC"})
SPINDLE_WORDS = frozenset({"SPOS", "S", "M"})
#: Procedures of actions.
PROCEDURES = frozenset(
    {
        "RDISABLE", "STOPREOF", "DELDTG", "FTOC", "LOCK", "UNLOCK", "RESET", "SETM", "CLEARM", "SETAL", "GET",
        "RELEASE", "PRESETON", "TRAILON", "TRAILOF", "LEADON", "LEADOF", "ICYCON", "ICYCOF", "FOCON", "FOCOF",
        "AXTOCHAN",
    }
)  # fmt: skip
#: Axes are commanded by these.
COMMANDING = frozenset({"POS", "MOV", "GET", "RELEASE", "AXTOCHAN", "TRAILON", "LEADON"})
_MODIFIERS = frozenset({"AC", "IC", "DC", "ACP", "ACN"})


def is_live(variable: str) -> bool:
    """Whether a system variable is read in every cycle: `$A…`, `$V…`, `$R…`, `$$…` (10.3.1)."""
    return variable.startswith(("$A", "$V", "$R", "$$"))


#: What shifts an axis beside everything else.
OVERLAY = "$AA_OFF"


def is_synchronised(variable: str) -> bool:
    """Whether a user variable is one of those that actions read and write (SYG_…, 10.3.3)."""
    return variable.startswith("SYG_")


class LiveReader(ExpressionReader):
    """Reads the tokens of an action.

    Args:
        block: The block that prepares it: its emitter gets the code of what is worked out once.
        parameters: Parameters of the technology cycle whose line this is.

    Attributes:
        frozen: Code of the values that are worked out once.
        needs: What has been read so far.
    """

    def __init__(self, block: ExpressionReader, parameters: Mapping[str, Variable] | None = None) -> None:
        super().__init__(list(block.tokens), block.scope, Emitter(block.scope.control.shapes))
        self.place = block.place
        self.block = block
        self.frozen: list[Code] = []
        self.needs = Needs()
        self._parameters = parameters or {}

    # ---- operands ------------------------------------------------------------------------------------------

    def operand(self) -> Expr:
        """Read an operand; one that belongs to preparation is worked out there."""
        token = self.token
        own = self._parameters.get(token.text) if token.kind == "name" else None
        if own is not None:
            self.take()
            return Expr(item(_OWN, constant(own.slot)), own.type)
        if self._is_live_function(token):
            return self._live_function(self.take())
        if not self._is_prepared(token):
            if token.kind == "name" and token.text[0] == "$":
                self.needs |= Needs(reads=frozenset({token.text}))
            return super().operand()
        block = self.block
        waits, block.place = block.emitter.uses_stop, self.place
        value = block.operand()
        self.place = block.place
        if block.emitter.uses_stop and not waits:  # 10.2: a variable of the main run in its index
            raise self.refused(token)
        self.frozen.append(value.code)
        return Expr(item(_FROZEN, constant(len(self.frozen) - 1)), value.type)

    def _is_prepared(self, token: Token) -> bool:
        if token.kind == "word":
            return token.letter == "R" and token.text not in self.scope.memory.axes
        if token.kind != "name":
            return False
        if token.text[0] == "$":
            return not is_live(token.text)
        if self.scope.find(token.text) is not None:
            return not is_synchronised(token.text)
        return token.text == "R" or token.text in keywords.CONTROL_FUNCTIONS

    def _is_live_function(self, token: Token) -> bool:
        return token.kind == "name" and token.text in LIVE_FUNCTIONS and self.scope.find(token.text) is None

    def _live_function(self, token: Token) -> Expr:
        """POSRANGE, CTAB: the main run answers."""
        self.needs |= Needs(reads=frozenset({token.text}))
        arguments = self.scope.arguments(self, token, keywords.CONTROL_FUNCTIONS[token.text].arguments)
        result = keywords.CONTROL_FUNCTIONS[token.text].result
        return Expr(quoted("{0}.function({1}, {2})", _ACTING, token.text, arguments), result)

    def reference(self, token: Token) -> Code:
        """A variable that a function may change: one that actions may write (12580 for others)."""
        place = self._place_of(token)
        if isinstance(place, SystemPlace):
            return quoted("{0}.reference({1}, {2})", _ACTING, place.code, place.indices)
        return place.reference(self)

    def refused(self, token: Token) -> NcSyntaxError:
        """12571: the word cannot stand in an action."""
        return NcSyntaxError("12571", token.column, token.text)

    # ---- effects -------------------------------------------------------------------------------------------

    def effect(self) -> None:
        """Read one thing that an action does."""
        token = self.token
        if token.kind == "word":
            self._number_word()
        elif token.kind != "name":
            raise self.error()
        elif token.text[0] == "$" or self.scope.find(token.text) is not None:
            self._assignment()
        elif token.text == "SYNFCT":
            self._synchronised_function()
        elif token.text in PROCEDURES and self.ahead().text != "[":
            self._procedure()
        elif token.text in AXIS_WORDS or token.text in SPINDLE_WORDS:
            self._axis_word()
        else:
            raise self.refused(token)

    def _number_word(self) -> None:
        """`M3`, `S1000`, `H510`, `M2=3`, `S2=500`, `G71`."""
        token = self.take()
        if token.text in UNITS:
            self._do("use_unit", constant(token.text))
            return
        if token.letter == "R" and self.at("="):
            raise NcSyntaxError("12580", token.column, token.text)
        if token.letter not in "MSH":
            raise self.refused(token)
        self.needs |= Needs(words=frozenset({token.letter}))
        if self.accept("="):
            value = self.expression()
            self._do("word", constant(token.letter), constant(int(token.value)), constant(""), value.code)
        else:
            number = self.emitter.number(token.value, token._replace(start=token.start + 1))
            self._do("word", constant(token.letter), constant(None), constant(""), number)

    def _axis_word(self) -> None:
        """`POS[X]=IC(10)`, `FA[X]=100`, `SPOS[2]=90`, `S=…`, `MEAWA[X]=(1,1)`, `FOCON[X]`."""
        token = self.take()
        index: Code = constant(None)
        if self.at("["):
            self.take()
            index = self._indexed(token)
            self.expect("]")
        elif token.text in AXIS_WORDS:
            raise self.error()
        self.needs |= Needs(words=frozenset({token.text}))
        if token.text in ("FOCON", "FOCOF"):
            self._do("word", constant(token.text), index, constant(""), constant(None))
            return
        self.expect("=")
        value, modifier = self.token, ""
        if value.text in _MODIFIERS and self.ahead().text == "(" and value.kind == "name":
            modifier = self.take().text
            self.expect("(")
            code = self.expression().code
            self.expect(")")
        elif self.at("(") and token.text in keywords.LIST_ADDRESSES:
            self.take()
            code = self._listed()
        else:
            code = self.expression().code
        self._do("word", constant(token.text), index, constant(modifier), code)

    def _listed(self) -> Code:
        values = [self.expression().code]
        while self.accept(","):
            values.append(self.expression().code)
        self.expect(")")
        return sequence(values)

    def _indexed(self, word: Token) -> Code:
        """The axis or spindle in brackets; which one it is is noted where the text says it."""
        token = self.token
        known = self.scope.memory.axes.get(token.text) if self.ahead().text == "]" else None
        if self.scope.find(token.text) is not None:
            known = None
        value = self.expression()
        if word.text in AXIS_WORDS and value.type is not Type.AXIS:
            raise NcSyntaxError("12040", token.column, token.text)
        if word.text in COMMANDING:
            self._commands(known)
        return value.code

    def _commands(self, axis: Axis | None) -> None:
        self.needs |= Needs(axes=frozenset({axis.name if axis is not None else None}))

    def _procedure(self) -> None:
        """`DELDTG(X)`, `RDISABLE`."""
        token = self.take()
        self.scope.check_word(token)
        names = [each.text for each in self.tokens[self.place :]]
        arguments = self.scope.arguments(self, token, "*")
        given_axes = [text for text in names if text in self.scope.memory.axes]
        bare = token.text == "DELDTG" and arguments == sequence(())
        self.needs |= Needs(words=frozenset({"DELDTG()" if bare else token.text}))
        if token.text in COMMANDING:
            for text in given_axes[:1] if token.text in ("TRAILON", "LEADON") else given_axes:
                self._commands(self.scope.memory.axes[text])
        self._do("procedure", constant(token.text), arguments)

    def _synchronised_function(self) -> None:
        """SYNFCT(n,output,input): the output gets the value of a function of FCTDEF (10.4.7)."""
        self.take()
        self.expect("(")
        number = self.value(Type.INT)
        self.expect(",")
        token = self.token
        place = self._live_place()
        self.expect(",")
        value = self.value(Type.REAL)
        self.expect(")")
        result = Expr(quoted("{0}.polynomial({1}, {2})", _ACTING, number, value), Type.REAL)
        self._store(place, self.converted(result, place.type, token))

    # ---- assignments ---------------------------------------------------------------------------------------

    def _assignment(self) -> None:
        """`variable=expression`, `=SET(…)`, `=REP(…)`."""
        place = self._live_place()
        self.expect("=")
        fill = self.token
        if fill.text in ("SET", "REP") and fill.kind == "name" and self.ahead().text == "(":
            self._fill(place, self.take())
            return
        token = self.token
        self._store(place, self.converted(self.expression(), place.type, token))

    def _live_place(self) -> Place:
        """A variable that actions may write: 12580 for one of preparation."""
        return self._place_of(self.take())

    def _place_of(self, token: Token) -> Place:
        found = token.kind == "name" and (
            is_live(token.text) if token.text[0] == "$" else is_synchronised(token.text)
        )
        if not found:
            raise NcSyntaxError("12580", token.column, token.text)
        shifts = frozenset({self._named_axis()} if token.text == OVERLAY else ())
        self.needs |= Needs(words=frozenset({token.text}), shifts=shifts)
        return self.scope.place(self, token)

    def _named_axis(self) -> str | None:
        """The axis that stands in the brackets of a variable; None for one that only the main run knows."""
        names = [token.text for token in self.tokens[self.place : self.place + 3]]
        known = names[:1] == ["["] and names[2:] == ["]"] and self.scope.find(names[1]) is None
        axis = self.scope.memory.axes.get(names[1]) if known else None
        return None if axis is None else axis.name

    def _store(self, place: Place, code: Code) -> None:
        if place.type is Type.INT:  # 10.3.2: a REAL beyond the range of INT is an alarm
            code = quoted("checked_int({0})", code)
        if isinstance(place, SystemPlace):
            self._do("store", place.code, place.indices, place.stored(self, code))
        elif isinstance(place, RPlace):
            self._do("store_item", place.values, place.index, place.stored(self, code))
        else:
            items, index = place.elements(self, self.token)
            self._do("store_item", items, index, place.stored(self, code))

    def _fill(self, place: Place, word: Token) -> None:
        """SET fills elements one after the other, REP the rest of the array (10.4.24)."""
        self.expect("(")
        codes: list[Code] = []
        while True:
            token = self.token
            if place.type is Type.AXIS and token.text == "NO_AXIS":
                raise self.error()
            codes.append(place.stored(self, self.converted(self.expression(), place.type, token)))
            if not self.accept(","):
                break
        self.expect(")")
        if word.text == "REP" and len(codes) > 1:
            raise self.error(word)
        repeats = word.text == "REP"
        if isinstance(place, SystemPlace):
            self._do("repeat" if repeats else "store_all", place.code, place.indices, sequence(codes))
            return
        items, start = place.elements(self, word)
        self._do("repeat_items" if repeats else "store_items", items, start, sequence(codes))

    # ---- code ----------------------------------------------------------------------------------------------

    def _do(self, method: str, *arguments: Code) -> None:
        self.emitter.run(call(Code((nodes.Attribute, _ACTING, method, nodes.Load)), *arguments))

    def calls(self, cycle: object, arguments: Code) -> None:
        """Add the call of a technology cycle."""
        self._do("call", self.emitter.object(cycle), arguments)

    def compiled_condition(self) -> Condition:
        """Read a condition: a function of the main run."""
        own, self.emitter = self.emitter, Emitter(self.scope.control.shapes)
        code = self.condition()
        function = self._made((given(code),))
        self.emitter = own
        return function

    def compiled_effect(self) -> Effect:
        """What has been read, as a function of the main run."""
        return self._made((*self.emitter.statements, given()))

    def _made(self, body: Body) -> Callable[..., Any]:
        emitter = self.emitter
        values = (*(number.value for number in emitter.numbers), *emitter.objects)
        function = Function(PARAMETERS, len(emitter.numbers), len(emitter.objects), body)
        try:
            return emitter.shapes.function(function, values)
        except TooDeepError:
            raise NcSyntaxError("12540", 1) from None

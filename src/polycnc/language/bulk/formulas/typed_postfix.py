"""From the code of expressions whose values have types to what the scanner calculates.

Code of the NC language knows at each place whether a value is whole, a REAL or a truth, and says so in Python's own
terms: `int`, `float`, `bool`. On the stack they are one kind of number. So a whole number must stay exact and its zero
has no sign, and what only types tell apart is left to the interpreter.
"""

from __future__ import annotations

from enum import Enum, auto

from polycnc.deferred.named_tuples import NamedTuple
from polycnc.deferred.typing import TYPE_CHECKING
from polycnc.language.bulk.formulas.postfix import OtherError
from polycnc.language.bulk.layout import HELD, STACK, Operation
from polycnc.language.expressions import nodes
from polycnc.language.expressions.code import Code, Lifted, constant
from polycnc.language.expressions.operators import checked_value

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence


class Sort(Enum):
    """What a value is."""

    WHOLE = auto()
    REAL = auto()
    TRUTH = auto()


class Located(NamedTuple):
    """Where a variable lies.

    Attributes:
        sort: What its values are.
        place: Its place, or that of the first element; that of its number among those of the block, if `numbered`.
        element: Code of the index of an element, which has been checked.
        numbered: The block says its number.
    """

    sort: Sort
    place: int
    element: Code | None = None
    numbered: bool = False


class Function(NamedTuple):
    """A function: what its arguments may be, what it does, and what comes of it (None: what the arguments are)."""

    arguments: tuple[frozenset[Sort], ...]
    operation: int
    gives: Sort | None


#: By the types of Python's values.
_SORTS: dict[type, Sort] = {int: Sort.WHOLE, float: Sort.REAL, bool: Sort.TRUTH}
_NUMBER, _WHOLE = frozenset((Sort.WHOLE, Sort.REAL)), frozenset((Sort.WHOLE,))
_ONE, _TWO = (_NUMBER,), (_NUMBER, _NUMBER)
_FUNCTIONS = {
    "sind": Function(_ONE, Operation.SIN, Sort.REAL),
    "cosd": Function(_ONE, Operation.COS, Sort.REAL),
    "tand": Function(_ONE, Operation.TAN, Sort.REAL),
    "asind": Function(_ONE, Operation.ASIN, Sort.REAL),
    "acosd": Function(_ONE, Operation.ACOS, Sort.REAL),
    "atan2d": Function(_TWO, Operation.ATAN2, Sort.REAL),
    "root": Function(_ONE, Operation.SQRT, Sort.REAL),
    "square": Function(_ONE, Operation.SQUARE, Sort.REAL),
    "trunc": Function(_ONE, Operation.TRUNC, Sort.WHOLE),
    "ceil": Function(_ONE, Operation.CEIL, Sort.WHOLE),
    "abs": Function(_ONE, Operation.ABS, None),
    "min": Function(_TWO, Operation.LESSER, None),
    "max": Function(_TWO, Operation.GREATER_ONE, None),
    "near": Function(_TWO, Operation.NEAR, Sort.TRUTH),
    "int_quotient": Function((_WHOLE, _WHOLE), Operation.QUOTIENT, Sort.WHOLE),
    "real_quotient": Function(_TWO, Operation.QUOTIENT, Sort.REAL),
}
_OPERATORS: dict[object, int] = {
    nodes.Add: Operation.ADD,
    nodes.Sub: Operation.SUBTRACT,
    nodes.Mult: Operation.MULTIPLY,
    nodes.Div: Operation.DIVIDE,
}
_COMPARISONS: dict[object, int] = {
    nodes.Eq: Operation.EQUAL,
    nodes.NotEq: Operation.NOT_EQUAL,
    nodes.Gt: Operation.GREATER,
    nodes.GtE: Operation.GREATER_OR_EQUAL,
    nodes.Lt: Operation.LESS,
    nodes.LtE: Operation.LESS_OR_EQUAL,
}
_LOGIC: dict[object, int] = {nodes.And: Operation.AND, nodes.Or: Operation.OR}
#: Constants of the language's own code that go onto the stack.
_LARGEST_ARGUMENT = 2**31 - 1
_HALF = constant(0.5)


class TypedPostfix:
    """Operations of one or more pieces of code.

    Args:
        sort_of_number: What a number of the code is, by its place.
        literal: Where a number of the code stands among those of the line.
        locate: Where a variable lies; raises `OtherError` for one that the scanner does not have.
        objects: Objects of the code, among which values may be that are not written in the block.

    Attributes:
        done: Pairs of operation and argument so far.
    """

    def __init__(
        self,
        sort_of_number: Callable[[int], Sort],
        literal: Callable[[int], int],
        locate: Callable[[Code], Located],
        objects: Sequence[object] = (),
    ) -> None:
        self._sort_of_number, self._literal, self._locate = sort_of_number, literal, locate
        self._objects = objects
        self._ways: dict[object, Callable[[Code], Sort]] = {
            nodes.Constant: self._put_constant,
            nodes.Subscript: self._put_variable,
            nodes.NamedExpr: self._put_bound,
            nodes.Name: self._put_name,
            nodes.BinOp: self._put_calculated,
            nodes.UnaryOp: self._put_signed,
            nodes.Compare: self._put_comparison,
            nodes.BoolOp: self._put_logic,
            nodes.Call: self._put_call,
            nodes.IfExp: self._put_chosen,
        }
        self._held: dict[object, tuple[int, Sort]] = {}
        self._depth = 0
        self.done: list[int] = []

    def stored(self, code: Code, slot: int) -> None:
        """Add what makes a value that of a word.

        Raises:
            OtherError: It is the interpreter's.
        """
        self._need(self._put(code), Sort.REAL)
        self._add(Operation.STORE, slot, -1)

    def condition(self, code: Code) -> None:
        """Add what leaves 1 on the stack where a condition holds, else 0; as `stored`."""
        self._need(self._put(code), Sort.TRUTH)
        self._depth = 0

    def assignment(self, code: Code) -> None:
        """Add what gives a variable a value; as `stored`."""
        targets, value = code[1], code[2]
        assert isinstance(targets, tuple)
        assert isinstance(value, Code)
        located = self._locate(targets[0])
        self._need(self._put(value), located.sort)
        if located.element is not None:
            self._need(self._put(located.element), Sort.WHOLE)
            self._add(Operation.PUT_ELEMENT, located.place, -2)
        else:
            self._add(Operation.ASSIGN if located.numbered else Operation.PUT, located.place, -1)

    def handed(self, code: Code, located: Located) -> None:
        """Add what gives a variable at a place a value; as `stored`."""
        self._need(self._put(code), located.sort)
        self._add(Operation.PUT, located.place, -1)

    def _add(self, operation: int, argument: int = 0, more: int = 0) -> None:
        """Add an operation; so many more values are on the stack then."""
        self._depth += more
        if self._depth > STACK:
            raise OtherError
        self.done += (operation, argument)

    @staticmethod
    def _need(found: Sort, wanted: Sort) -> None:
        if found is not wanted:
            raise OtherError

    # ---- values --------------------------------------------------------------------------------------------

    def _put(self, code: Code) -> Sort:
        """Add the operations of code; gives what its value is."""
        checked = checked_value(code)
        if checked is not None:
            return self._put(checked)
        if isinstance(code, Lifted):
            if code.letter != "n":
                return self._put_object(code.place)
            self._add(Operation.NUMBER, self._literal(code.place), 1)
            return self._sort_of_number(code.place)
        put = self._ways.get(code.kind)
        if put is None:
            raise OtherError
        return put(code)

    def _put_constant(self, code: Code) -> Sort:
        return self._put_value(code[1])

    def _put_object(self, place: int) -> Sort:
        if place >= len(self._objects):
            raise OtherError
        return self._put_value(self._objects[place])

    def _put_value(self, value: object) -> Sort:
        """A value that is known, and small and whole."""
        sort = _SORTS.get(type(value))
        if sort is None or not isinstance(value, (int, float)) or abs(value) > _LARGEST_ARGUMENT:
            raise OtherError
        if value != int(value) or str(value) == "-0.0":
            raise OtherError
        self._add(Operation.ARGUMENT, int(value), 1)
        return sort

    def _put_variable(self, code: Code) -> Sort:
        located = self._locate(code)
        if located.element is not None:
            self._need(self._put(located.element), Sort.WHOLE)
            self._add(Operation.ELEMENT, located.place)
        elif located.numbered:
            self._add(Operation.VARIABLE, located.place, 1)
        else:
            self._add(Operation.PLACE, located.place, 1)
        return located.sort

    def _put_bound(self, code: Code) -> Sort:
        """`(t0 := value)`: it is kept for later."""
        target, value = code[1], code[2]
        assert isinstance(target, Code)
        assert isinstance(value, Code)
        sort, place = self._put(value), len(self._held)
        if place >= HELD:
            raise OtherError
        self._held[target[1]] = place, sort
        self._add(Operation.HOLD, place)
        return sort

    def _put_name(self, code: Code) -> Sort:
        """What has been kept."""
        if code[1] not in self._held:
            raise OtherError
        place, sort = self._held[code[1]]
        self._add(Operation.HELD, place, 1)
        return sort

    # ---- operators -----------------------------------------------------------------------------------------

    def _put_calculated(self, code: Code) -> Sort:
        _, left, operator, right = code
        assert isinstance(left, Code)
        assert isinstance(right, Code)
        sorts = self._put(left), self._put(right)
        operation = _OPERATORS.get(operator)
        if operation is None:
            raise OtherError
        self._add(operation, 0, -1)
        if Sort.REAL in sorts or operator == nodes.Div:
            return Sort.REAL
        self._add(Operation.EXACT)
        return Sort.WHOLE

    def _put_signed(self, code: Code) -> Sort:
        operator, operand = code[1], code[2]
        assert isinstance(operand, Code)
        sort = self._put(operand)
        if operator == nodes.Not:
            self._need(sort, Sort.TRUTH)
            self._add(Operation.NOT)
            return sort
        if operator not in (nodes.USub, nodes.UAdd):
            raise OtherError
        if operator == nodes.USub:
            self._add(Operation.NEGATIVE)
        if sort is Sort.REAL:
            return sort
        self._add(Operation.EXACT)
        return Sort.WHOLE

    def _put_comparison(self, code: Code) -> Sort:
        left, operators, others = code[1], code[2], code[3]
        assert isinstance(left, Code)
        assert isinstance(operators, tuple)
        assert isinstance(others, tuple)
        if len(operators) > 1 or operators[0] not in _COMPARISONS:
            raise OtherError
        self._put(left)
        self._put(others[0])
        self._add(_COMPARISONS[operators[0]], 0, -1)
        return Sort.TRUTH

    def _put_logic(self, code: Code) -> Sort:
        """Both sides are worked out: what would not be in the interpreter changes nothing, and alarms there only."""
        parts = code[2]
        assert isinstance(parts, tuple)
        for part in parts:
            self._need(self._put(part), Sort.TRUTH)
        self._add(_LOGIC[code[1]], 0, -1)
        return Sort.TRUTH

    # ---- functions -----------------------------------------------------------------------------------------

    def _put_call(self, code: Code) -> Sort:
        function, arguments = code[1], code[2]
        assert isinstance(function, Code)
        assert isinstance(arguments, tuple)
        name = function[1] if function.kind == nodes.Name else None
        known = _FUNCTIONS.get(str(name))
        if known is not None:
            return self._put_function(known, arguments)
        if len(arguments) != 1 or name not in _CONVERSIONS:
            raise OtherError
        if name == "floor":
            arguments = (_without_half(arguments[0]),)
        sort = self._put(arguments[0])
        for operation in _CONVERSIONS[name][1]:
            self._add(operation)
        allowed, _, gives = _CONVERSIONS[name]
        if sort not in allowed:
            raise OtherError
        return gives

    def _put_function(self, function: Function, arguments: tuple[Code, ...]) -> Sort:
        if len(arguments) != len(function.arguments):
            raise OtherError
        sorts = [self._put(argument) for argument in arguments]
        if any(sort not in allowed for sort, allowed in zip(sorts, function.arguments, strict=True)):
            raise OtherError
        if function.gives is None and len(set(sorts)) > 1:
            raise OtherError  # the interpreter gives back the very argument, of whichever type
        self._add(function.operation, 0, 1 - len(arguments))
        return function.gives or sorts[0]

    def _put_chosen(self, code: Code) -> Sort:
        """`value if … else alarm`, as indices and results are asked whether they are in range, and MOD."""
        test, otherwise = code[1], code[3]
        assert isinstance(test, Code)
        assert isinstance(otherwise, Code)
        function = otherwise[1] if otherwise.kind == nodes.Call else None
        name = function[1] if isinstance(function, Code) and function.kind == nodes.Name else None
        if name == "remainder":
            return self._put_remainder(test)
        others = test[3]
        if name not in ("checked_int", "out_of_range") or not isinstance(others, tuple):
            raise OtherError
        value, limit = others
        self._need(self._put(value), Sort.WHOLE)
        if name == "checked_int":
            self._add(Operation.INTEGER)
        elif limit.kind == nodes.Constant and isinstance(limit[1], int):
            self._add(Operation.WITHIN, limit[1])
        else:
            raise OtherError
        return Sort.WHOLE

    def _put_remainder(self, test: Code) -> Sort:
        """MOD: operands are where they are asked for their signs."""
        sides = test[1], test[3]
        sorts = set()
        for side in sides:
            operand = side[1] if isinstance(side, Code) else None
            assert isinstance(operand, Code)
            sorts.add(self._put(operand))
        if len(sorts) > 1 or Sort.TRUTH in sorts:
            raise OtherError
        self._add(Operation.REMAINDER, 0, -1)
        if Sort.WHOLE in sorts:
            self._add(Operation.EXACT)
        return sorts.pop()


def _without_half(code: Code) -> Code:
    """`x` of `floor(x + 0.5)`."""
    if code.kind != nodes.BinOp or code[2] != nodes.Add or code[3] != _HALF:
        raise OtherError
    assert isinstance(code[1], Code)
    return code[1]


_ANY = frozenset(Sort)
#: By their names: what they take, what is done, what comes of it.
_CONVERSIONS: dict[object, tuple[frozenset[Sort], tuple[int, ...], Sort]] = {
    "float": (_ANY, (), Sort.REAL),
    "finite": (frozenset((Sort.REAL,)), (), Sort.REAL),
    "int": (frozenset((Sort.TRUTH,)), (), Sort.WHOLE),
    "checked_int": (_WHOLE, (Operation.INTEGER,), Sort.WHOLE),
    "floor": (_NUMBER, (Operation.ROUND,), Sort.WHOLE),
    "round_half_up": (_NUMBER, (Operation.ROUND, Operation.INTEGER), Sort.WHOLE),
}

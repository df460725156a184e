"""The kinds of nodes that trees of generated code have, by the names that `ast` has for their classes.

`ast` itself takes longer to load than many a program runs: half of that are these classes, which `_ast` makes, and
half what they need not. So `_ast` is loaded, where code is compiled: by `code.node`, `code.quoted` and `shapes`.
"""

from __future__ import annotations


class Kind(str):
    """The name of a class of `ast`; in a tree it is told from texts by its type."""

    __slots__ = ()


# Of expressions.
Attribute = Kind("Attribute")
BinOp = Kind("BinOp")
BoolOp = Kind("BoolOp")
Call = Kind("Call")
Compare = Kind("Compare")
Constant = Kind("Constant")
IfExp = Kind("IfExp")
List = Kind("List")
Name = Kind("Name")
NamedExpr = Kind("NamedExpr")
Set = Kind("Set")
Subscript = Kind("Subscript")
Tuple = Kind("Tuple")
UnaryOp = Kind("UnaryOp")
# Of statements.
Assign = Kind("Assign")
AugAssign = Kind("AugAssign")
Break = Kind("Break")
Delete = Kind("Delete")
ExceptHandler = Kind("ExceptHandler")
Expr = Kind("Expr")
For = Kind("For")
If = Kind("If")
Pass = Kind("Pass")
Return = Kind("Return")
Try = Kind("Try")
# What becomes of a name, an attribute or an item.
Del = Kind("Del")
Load = Kind("Load")
Store = Kind("Store")
# Operators between two operands.
Add = Kind("Add")
BitAnd = Kind("BitAnd")
BitOr = Kind("BitOr")
BitXor = Kind("BitXor")
Div = Kind("Div")
FloorDiv = Kind("FloorDiv")
MatMult = Kind("MatMult")
Mult = Kind("Mult")
Sub = Kind("Sub")
# Comparisons.
Eq = Kind("Eq")
Gt = Kind("Gt")
GtE = Kind("GtE")
Is = Kind("Is")
IsNot = Kind("IsNot")
Lt = Kind("Lt")
LtE = Kind("LtE")
NotEq = Kind("NotEq")
# Logical operators.
And = Kind("And")
Or = Kind("Or")
# Operators before an operand.
Invert = Kind("Invert")
Not = Kind("Not")
UAdd = Kind("UAdd")
USub = Kind("USub")

COMPARISONS = frozenset((Eq, Gt, GtE, Is, IsNot, Lt, LtE, NotEq))
LOGIC = frozenset((And, Or))

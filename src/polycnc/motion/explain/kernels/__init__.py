"""Which limit held, as kernels over the arrays of a plan.

`held` has what they share: the numbers of causes, the notes of rows, the account. `notes` works out what bounds a row,
by the planner's own functions; `bounds` what bounds a piece of it; `pieces` shares time and way of pieces out, `law`
those of pieces that a law of third order leads; `rapids` those of rapids on which every axis runs alone.
"""

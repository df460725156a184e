"""Turning cycles as strokes (`stroke`): `single`, `rough` with `pockets`, `pattern`, `peck`, `grinding`.

`cuts` is what roughing is told. `contour` is what a cycle follows, `outline` leads it on to its blank, `allowance`
leaves stock on it, `stock_removal` cuts it whole; `thread` is one pass and its run-out, `thread_chain` several parts;
`groove` is cut with a parting tool, `undercut` lies at a shoulder.
"""

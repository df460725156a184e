"""The SYNTEC milling control: what differs from the word-address base, and its macro language.

`control` states what it is, `family` its channel, `codes` has its G and M tables, `rules` what acts on
blocks beside them, `builder` reads a block's shape,
`plain` tells plain blocks to the scanner; `memory`, `parameters`, `units` (least input units), `alarm_codes`,
`cycles` (drilling, hole patterns), `tapping`, `spindles`.

    motion/        moves, arcs, planes, polar plane, dwells, skips, smoothing, oscillation
    coordinates/   G52 to G59, G68, G10; length; tool setting
    five_axes/     tilted planes, tool tip control, compensation in space
    macros/        calls, functions, variables, interrupts
    axis_groups/   several groups of axes, borrowed axes
"""

"""SINUMERIK 840D sl: G groups, words, frames, tools, system variables and alarms of the control.

`control` states what it is, `family` how a type checker knows its channel, `gcodes` has the groups; `memory`, `reset`,
`auxiliary` (M), `tables` and `errors` that several modules share.

    block/       what a block does: plans, words, procedures
    motion/      moves, circles, splines, repositioning
    feed/        feeds, overrides, spindles
    frames/      frames and their variables
    tools/       tool memory, compensation, smooth approach
    limits/      working areas, protection zones
    signals/     measuring, interrupt routines, retraction
    channels/    several channels
    variables/   system variables
    data/        machine data, archives
    cycles/      the machining cycles
"""

"""SINUMERIK 840D sl: G groups, words, frames, tools, system variables and alarms of the control.

`control` states what it is, `family` how a type checker knows its channel, `gcodes` has the groups; `memory`, `reset`,
`modal_state` (SAVE), `auxiliary` (M), `m_functions` (their numbers), `replaced` (programs in place of M and T),
`axis_names`, `tables` and `errors` that several modules share.

    actions/     synchronised actions in the main run
    axes/        geometry axes
    block/       what a block does: plans, words, procedures
    couplings/  axes that follow others
    curve_tables/ curve tables
    motion/      moves, circles, splines, repositioning
    feed/        feeds, overrides, spindles
    frames/      frames and their variables
    tools/       tool memory, compensation, smooth approach
    tangential/  axes that follow the direction of the path
    oscillation/ axes that move to and fro
    punching/    strokes of a press, segments of paths
    limits/      working areas, protection zones
    contours/    contour tables for stock removal
    signals/     measuring, interrupt routines, retraction
    channels/    several channels
    variables/   system variables
    data/        machine data, archives
    cycles/      the machining cycles
    iso/         functions of the ISO dialect
"""

"""What the word-address controls share: plans of blocks, words, and the handlers of common codes.

`control` is the base class, `machining_centre` that of milling controls; `rules` has what acts on few blocks as rows,
`states` what features ask of each other; `memory` is what they keep, `reset` what ends, `parameters` what is read of a
control's parameters here, `family` the channels that handlers take.

    block/            what a block of some shape does in some modal state
    motion/           G00 to G03 and everything beside it
    coordinates/      work coordinate systems, frames, stroke check
    tools/            length, radius, measuring, G10
    cycles/           drilling, hole patterns
    transformations/  cylinder, polar plane, tilted plane, tool centre point, normal line
    macro_b/          variables, calls, subprograms, interruption
    auxiliary/        F, S, T, M; overrides; interlocks
"""

"""What a block does: `plan` works it out once in each modal state, on a `draft` of who takes which word.

`words` are addresses beside motion, `positions` axis words, `procedures` the predefined ones with their `arguments`;
`offset_words` are those of tool offsets, `outside_feeds` FMA, ST and FD; `single_block` says where a block halts,
`plain` tells plain blocks as data for the scanner, `routines` loops and assignments; `variables_at_hand` are what both
calculate with.
"""

"""What a block does: `plan` works it out once in each modal state, on a `draft` of who takes which word.

`words` are addresses beside motion, `positions` axis words, `procedures` the predefined ones with their `arguments`;
`offset_words` are those of tool offsets, `outside_feeds` FMA, ST and FD; `single_block` says where a block halts,
`plain` tells steps as data for the scanner, `scanned` is what the scanner asks, `routines` what it asks of loops, calls
and assignments; `variables_at_hand` are what all these calculate with.
"""

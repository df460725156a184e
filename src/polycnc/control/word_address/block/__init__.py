"""What a block does: `plan` works it out once for each shape in each modal state.

`rules` says what acts on a block beside its own codes and words, and when; each control declares its tuple of them.
`codes` has the rows of the code tables, `words` the words as a handler sees them, `numbers` their units and decimal
points, `whole_numbers` the words that take none. `single_block` says behind which blocks single block
halts. `plain`, `words_as_data` and `repeated_codes` tell the same as data,
for the bulk scanner.
"""

"""Custom macro B: `variables`, and programs that call programs.

`macro_calls` (G65, G66), `code_calls` (calls by G, M and T codes), `subprograms` (M98), `interruption` (M96),
`parameter_input` (G10 L50), `single_block`; `plain`, `routines` and `calls_as_data` tell the scanner of formulas, of
statements and of calls; `custom_macro` is what controls with it share.
"""

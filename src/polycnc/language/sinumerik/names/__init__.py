"""Names and values of a program.

`scope` says what a name means, `variables` what DEF declares, `places` where values lie; `level_variables` tell of the
running programs, `values` are the types, `frame` the type FRAME; `spindles` says which axes spindles are. `units`,
`vocabulary` (what a name is), `rights`; `definition_files` and `initialisation` give first values.
"""

"""The FANUC 0i-TF Plus lathe (`fanuc-0i-tf`).

`control` states what it is, `family` its channel, `codes` and `rules` have its tables; `states`, `memory`, `reset`,
`variables` (of the system), `auxiliary` (dwell, surface speed …), `spindle_indexing`, `balance` (two turrets at
once). `parameters.toml` has the parameters; `parameters`, their values by mnemonic, is written from it.

    motion/        threads, corners, lines by drawing dimensions
    coordinates/   coordinate systems, limits of travel
    tools/         T and offsets, nose radius, G10, measuring, offset screens
    cycles/        single, repetitive, drilling and grinding cycles
"""

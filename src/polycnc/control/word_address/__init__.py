"""What the word-address controls share: plans of blocks, words, and the handlers of common codes.

a block       plan (what it does in a modal state), codes (rows of the tables), words, numbers (units, points),
control (the base class), milling (that of machining centres), memory, reset
bulk          plain, words_as_data, settled: the same told as data, for the scanner
motion        path (G00 to G03), arcs, planes, thread (G33), nurbs (G06.2), skip (G31), path_modes (G05, G08, G09),
circle_cutting (G12, G13), position_offset (G45 to G48, G60), corners (`,C` `,R`),
line_by_angle (`,A`)
coordinates   coordinates (G52 to G59, G92, G28 to G30), frames (G51, G68, G16), stroke_check (G22, G23)
tools         length (G43), radius (G40 to G42), corner_vectors (G38, G39), tool_measuring (G37), data_input (G10)
cycles        drilling (G73 to G89), hole_patterns
five axes     tilted_plane (G68.2), tool_center_point (G43.4), normal_line (G41.1) with normal_stage
other paths   cylinder (G07.1), polar_interpolation (G12.1), hypothetical_axis (G07)
macro B       custom_macro, variables, macro_calls (G65, G66), code_calls, subprograms (M98), interruption (M96),
parameter_input (G10 L50)
auxiliary     auxiliary (F, S, T, M), overrides (M73 to M76), interlocks (the machine's own controller)
"""

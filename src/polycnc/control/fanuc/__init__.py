"""The FANUC family: machining centres (Hartford) and the 0i-TF Plus lathe.

Both: `system_variables`, `code_calls`, `operation`, `alarm_codes`. Machining centre: `milling` with `milling_codes`
(the tables), `milling_cycles`, `milling_variables`, and `hartford` (its M codes). The lathe: `turning` with

    a block       turning_codes (the tables), turning_auxiliary, turning_memory, turning_reset, turning_variables
    coordinates   turning_coordinates (G50, planes), turning_limits, turning_barrier, turning_data (G10)
    tools         turning_tools (T), turning_comp (G41), turning_measuring (G31, G36, G37), turning_sensor
    figures       turning_corners (chamfers), turning_drawing (direct drawing dimensions)
    cycles        turning_single (G90), turning_repetitive (G70 to G76) with turning_shape, turning_drilling,
                  turning_tapping, turning_grinding, turning_strokes, turning_intervention
    threads       turning_threads (G32, G34 to G36)
    two paths     turning_balance (G68, G69)
    screens       turning_screens, turning_files
"""

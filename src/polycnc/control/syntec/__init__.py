"""The SYNTEC milling control: what differs from the word-address base, and its macro language.

a block       codes (G and M tables), builder, plain, control, memory, parameters, alarm_codes
motion        motion (G00, G31, G33, G45 …), arcs, planes, polar (G12.1), quiet, skips, smoothing, oscillation,
operation
coordinates   coordinates (G52 to G59, G68, G10), length (G43), tool_setting (G37)
cycles        cycles (drilling, hole patterns)
five axes     tilted (G68.2), alignment (G53.1), tip_control (G43.4), spatial with spatial_stage (G41.2),
normal_direction (G41.1)
macros        calls (G65, G66, M98), functions, variables, system_variables, interrupts (M96)
axis groups   axis_groups, axis_borrowing (G52.2), axis_names
spindles      spindles
"""

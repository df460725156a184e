"""The MELDAS (Mitsubishi) family: a machining centre, told as what differs from FANUC's.

`milling` is the control, `milling_codes` its tables, `cycles` its drilling, `code_calls` the codes that call programs,
`tool_axis_length` the length along the tool (G43.1),
`parameters` (written from the list beside it), `alarm_codes` its alarms.
"""

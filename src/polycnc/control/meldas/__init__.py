"""The MELDAS (Mitsubishi) family: a Hartford machining centre, told as what differs from FANUC's.

`milling` is the control, `milling_codes` its table, `cycles` its drilling, `code_calls` the codes that call programs,
`hartford` its M codes, `alarm_codes` its alarms.
"""

"""The FANUC family: machining centres in `milling/`, the 0i-TF Plus lathe in `lathe/`.

Both have `system_variables`, `code_calls` (codes that call programs), `operation` (an operator's switches by
parameters), `acceleration` (time constants), `dwell` (G04), `tool_plane` (G68.3)
and `alarm_codes`. `parameters` has the
parameters of both (written from the list beside it), those of each stand in its folder.
"""

"""How the tool stands on the work, and which positions of the rotary axes stand it so.

`tool_centre` is the transformation that leads the tip (G43.4, TRAORI), `unled` the work under axes that nothing leads.
`solutions` finds the rotary positions for a direction of the tool, `choice` says which of several; `directions` are
ways of a direction, `turning` makes ways of the rotary axes of them. `linked` writes `tool_centre` for kernels,
`linkage` has these; `standing` is the kernel that finds the rotary positions for scanner and interpreter, `records`
names what it must know, and `stood` writes that.
"""

"""Auxiliary functions: `functions` (F, S, T, M), and codes of M.

`m_codes` has the M codes of any machining centre, `machine_codes` those of the machine's builder; `overrides` are what
a program takes out of the operator's hands, `interlocks` put blocks behind the machine's own controller.
"""

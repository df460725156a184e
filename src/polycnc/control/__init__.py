"""The control families: code tables, handlers, alarms; each states only how it differs.

`word_address` is what FANUC, MELDAS and SYNTEC share; `fanuc`, `meldas`, `syntec` and `sinumerik` are the
families. From a code to what it does: the table of codes
(`fanuc/milling/codes.py`, `fanuc/lathe/codes.py`, `meldas/milling_codes.py`, `syntec/codes.py`; on SINUMERIK
`gcodes.py` has the groups, `block/plan.py` the functions), then the handler that its row names, whose docstring begins
with the code. The head of its module names the manual's section.

`registry` finds a control by its id, `interface` says what all of them offer, `modal_groups` names their groups;
`alarm_text`, `data_files`, `tool_change` and `machine_words` (what the machine refuses) serve every family, as does
`signals` (as a program of a calculated run reads them) and `parameters` (values by mnemonic, from the list in a
`parameters.toml`; `parameter_module` writes the module that names them).
"""

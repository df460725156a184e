"""Data of the control.

`machine_data` are its machine and setting data (their list: `delivered`; what the machine file says of them:
`of_machine`; which words its control does without: `availability`), `access` protection levels, `archive` COMPLETE,
`init_programs` what runs in front of a selected program.
"""

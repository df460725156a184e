"""Data of the control: `machine_data`, `access` (protection levels), `archive` (COMPLETE), `init_programs`."""

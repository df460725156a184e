"""The SYNTEC milling control: code tables, macro calls, variables, alarms."""

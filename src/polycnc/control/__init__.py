"""The control families: code tables, handlers, alarms; each states only how it differs."""

"""SINUMERIK 840D sl: G groups, words, frames, tools, system variables and alarms of the control."""

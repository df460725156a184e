"""The NC language of SINUMERIK 840D sl: blocks, expressions, variables, flow and program calls, compiled to steps."""

"""Where the axes may not go: `working_area` (limits, WALIMON), `protection` (zones), `calcposi` (free distances)."""

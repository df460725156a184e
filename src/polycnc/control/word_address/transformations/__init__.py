"""Codes under which the axes that move are not those of the path.

`cylinder` (G07.1), `polar_interpolation` (G12.1) with `polar_stage`, and `hypothetical_axis` (G07);
`tilted_plane` (G68.2), `tool_center_point` (G43.4); `normal_line` (G41.1) with `normal_stage`;
`workpiece` (G54.2, G54.4) with `turned_tool`.
"""

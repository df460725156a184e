"""Machining cycles as generators of moves, free of any control's words.

A generator yields strokes (`mill_stroke` in a plane and its depth, `plane_stroke` on a lathe, `drilling` along a hole);
the control that runs it turns them into moves. Who calls what:

    holes     drilling, deep_hole, hole_patterns: every control; drilling_lathe: FANUC
    milling   pockets, slots, spigots, facing, path_milling, thread_milling: SINUMERIK
    turning   turning_single, turning_rough, turning_pockets, turning_pattern, turning_peck, threading, grinding: FANUC;
              stock_removal, thread_turning: SINUMERIK; contour: the shapes of both
"""

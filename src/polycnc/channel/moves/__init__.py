"""The way of a move: `path` has the stages between a handler's move and the toolpath, `move_path` the points on it."""

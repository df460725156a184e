"""The interpreter that all controls share: modal state, program stack, flow, frames, and the way of a move.

`channel` runs steps (`steps`, `stack`) and gives `waits`; `run` is the run of a program, `group` runs the channels of
one control together, `snapshot` notes a channel between two blocks and brings it back; `state` is what
features own of it, with its lifetime.
`mode` is the modal state, `coordinates` where the channel is, `path` the stages between a handler's move and
the toolpath, `move_path` the points on that move. `failure` says what an alarm does, `passes`
when a main program that begins again does nothing new, `intervention` what an
operator's hand does to a waiting program; `view` is where its axes are: prepared or
executed; `interface` is what the channel asks of those around it, `family` the
kinds of control and memory by which a channel is typed.
"""

"""The interpreter that all controls share: modal state, program stack, flow, frames, and the way of a move.

`channel` runs steps (`steps`, `stack`) and gives `waits`; `run` is the run of a program, `group` runs the channels of
one control together. `mode` is the modal state, `coordinates` where the channel is, `view` where its axes are: prepared
or executed; `interpolator` what acts in every cycle of a main run. `failure` says what an alarm does, `intervention`
what an operator's hand does to a waiting program;
`interface` is what the channel asks of those around it, `family` the kinds of control and memory by which a channel is
typed.

    states/   what features own of a channel, with its lifetime; snapshots
    moves/    from a handler's move to the toolpath
"""

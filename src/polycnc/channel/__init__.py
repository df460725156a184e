"""The interpreter that all controls share: modal state, program stack, flow, frames, and the way of a move."""

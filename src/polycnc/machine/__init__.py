"""Machines as data: axes with limits, spindles, magazine, kinematics; and the setup a run starts from."""

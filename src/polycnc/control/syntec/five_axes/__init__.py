"""Five axes on SYNTEC: `tilted` (G68.2), `alignment` (G53.1), `tip_control` (G43.4), `normal_direction` (G41.1).

`posture` is the direction of the tool in a turned work system (G43.4 Q1), `spatial` radius compensation in space
(G41.2), `mechanism` the parameters of the machine (Pr3001).
"""

"""Orientable toolholders: what is `stored` of them ($TC_CARR1 …), and the `active` one (TCARR, TCOFR, CUTMOD)."""

"""Several channels: `coordination` (INIT, WAITM …), `axis_exchange` (GET, RELEASE), `axis_containers` (AXCTSWE),
`link_memory` (`$A_DLB`).
"""

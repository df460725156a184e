"""Several channels: `coordination` (INIT, WAITM …), `axis_exchange` (GET, RELEASE), `link_memory` (`$A_DLB`).

`axis_requests` is axis exchange by actions. `axis_containers` lets channel axes mean other machine axes (AXCTSWE).
"""

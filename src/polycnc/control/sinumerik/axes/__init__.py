"""Which axes take part: `geometry` exchanges the geometry axes (GEOAX)."""

"""Which version of polycnc this is, and how files say what wrote them."""

__version__ = "0.1.0"
#: What the end of a Parquet file says of it.
MADE_BY = f"polycnc version {__version__}"

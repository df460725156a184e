"""System variables: `registry`, `row` of its tables, `known` (names that exist), `by_name` (reports), `functions`."""

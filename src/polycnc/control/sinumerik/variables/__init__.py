"""System variables: `registry`, `row`, `stored` values, `known` names that exist, `by_name` (reports), `functions`."""

"""System variables: `registry`, `known` (names that exist), `by_name` (for reports), `functions` of the state."""

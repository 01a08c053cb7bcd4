"""The cases: one short script each, with `measure(workspace)` and `draw(values, path)`."""

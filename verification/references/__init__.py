"""Reference solutions that do not use litz."""

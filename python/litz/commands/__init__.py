"""The commands of `litz` that need Python."""

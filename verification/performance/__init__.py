"""Measurements of time and memory; nothing here is a test."""

import os

from litz.base.program import program_environment

# before any library that has threads is loaded
os.environ.update(program_environment())

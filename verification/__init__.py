"""Verification of litz: claims with sources outside litz, measured and reported; `python -m verification.run`."""

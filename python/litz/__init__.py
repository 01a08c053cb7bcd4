"""litz: finite elements for beams in electro-mechanical contact."""

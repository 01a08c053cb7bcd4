"""What the fuzz tests share: the program that reads decks in a loop."""

import pytest


@pytest.fixture(scope="session")
def read_decks(build_target):
    return build_target("tests/read_decks")

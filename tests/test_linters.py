"""The linters: what runs them, and that their rules are written down."""

import json
import re
import sys
from pathlib import Path

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

ROOT = Path(__file__).parents[1]


def text(name):
    return (ROOT / name).read_text(encoding="utf-8")


def linters_of_setup():
    """The commands of the array `linters` of the script setup."""
    return re.findall("'(.+)'", re.search(r"^linters=\((.*?)^\)", text("setup"), re.MULTILINE | re.DOTALL)[1])


def test_a_commit_is_checked_by_the_commands_of_setup():
    hooks = re.findall(r"^ +entry: \.venv/bin/(.+)$", text(".pre-commit-config.yaml"), re.MULTILINE)
    assert hooks == linters_of_setup()
    assert {command.split()[0] for command in hooks} == {
        "ruff",
        "mypy",
        "fortitude",
        "python",
        "shellcheck",
        "codespell",
    }


def test_what_setup_runs_is_what_it_installs():
    group = tomllib.loads(text("pyproject.toml"))["dependency-groups"]["lint"]
    installed = {re.match(r"[a-z]+", requirement)[0] for requirement in group}
    assert {command.split()[0] for command in linters_of_setup()} - {"python"} <= installed


def test_each_linter_has_its_rules():
    tools = tomllib.loads(text("pyproject.toml"))["tool"]
    assert set(tools["ruff"]["lint"]["select"]) >= {"B", "D", "E", "F", "I", "NPY", "PL", "PT", "RUF", "SIM", "UP", "W"}
    assert tools["ruff"]["lint"]["pydocstyle"]["convention"] == "numpy"
    assert tools["mypy"]["files"] == ["python/litz"]
    assert tools["mypy"]["disallow_untyped_defs"]
    assert tools["codespell"]["ignore-words-list"]
    assert tomllib.loads(text("fortitude.toml"))["check"]["line-length"] == 120


def test_each_rule_that_is_left_out_has_a_reason():
    lists = re.findall(
        r"^ignore = \[\n(.*?)^\]", text("pyproject.toml") + text("fortitude.toml"), re.MULTILINE | re.DOTALL
    )
    assert len(lists) == 2
    for line in "".join(lists).splitlines():
        assert re.fullmatch(r' +"[A-Z]+\d+", +# .+', line), line


def test_the_settings_of_the_editors_can_be_read():
    for name in (".fortls", ".vscode/settings.json", ".vscode/extensions.json"):
        assert json.loads(text(name))

"""What an installation consists of."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

import litz

ROOT = Path(__file__).parents[1]


def declared_version():
    """The version that meson.build states."""
    return re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text(encoding="utf-8"))[1]


def test_the_program_states_the_version_of_meson_build(litz_program):
    shown = subprocess.run([litz_program, "--version"], capture_output=True, text=True, check=True).stdout
    assert shown.splitlines()[0] == f"litz {declared_version()}"


def test_citation_change_log_and_recipe_state_the_version_of_meson_build():
    assert f"\nversion: {declared_version()}\n" in (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    recipe = (ROOT / "packaging" / "conda" / "recipe.yaml").read_text(encoding="utf-8")
    assert f'\n  version: "{declared_version()}"\n' in recipe
    assert f"\n## {declared_version()}" in (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")


def test_importing_the_package_is_light():
    # the command line must not wait for these
    code = "import sys, litz, litz.cli; print(sorted({'numpy', 'h5py', 'vtk', 'pyvista', 'matplotlib'} & set(sys.modules)))"
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_every_public_name_can_be_had():
    for name in litz.__all__:
        assert getattr(litz, name) is not None


@pytest.mark.parametrize("script", ["setup", ".ci/run"])
def test_the_shell_scripts_are_valid_and_executable(script):
    assert (ROOT / script).stat().st_mode & 0o111
    subprocess.run(["bash", "-n", str(ROOT / script)], check=True)


def test_setup_explains_itself_without_setting_anything_up(tmp_path):
    copy = tmp_path / "setup"
    copy.write_bytes((ROOT / "setup").read_bytes())
    shown = subprocess.run(["bash", str(copy), "help"], capture_output=True, text=True, check=True)
    assert "./setup run" in shown.stdout
    wrong = subprocess.run(["bash", str(copy), "rnu"], capture_output=True, text=True, check=False)
    assert wrong.returncode == 1
    assert "no command 'rnu'" in wrong.stderr
    assert list(tmp_path.iterdir()) == [copy]


def test_setup_reads_the_build_requirements_from_pyproject():
    script = f"build_requirements() {{ {function_body('build_requirements')}; }}; root={ROOT}; build_requirements"
    shown = subprocess.run(["bash", "-c", script], capture_output=True, text=True, check=True).stdout
    assert [re.match(r"[\w-]+", line)[0] for line in shown.splitlines()] == ["meson-python", "meson", "ninja", "numpy"]


def function_body(name):
    """The body of a one-line function of the script setup."""
    return re.search(rf"^{name}\(\) {{ (.*); }}$", (ROOT / "setup").read_text(encoding="utf-8"), re.MULTILINE)[1]

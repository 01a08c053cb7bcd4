"""The command `litz` of the Python package."""

import os
import re
import subprocess
import sys

import pytest

import litz
from litz import cli

ENTRY = [sys.executable, "-c", "import sys; from litz.cli import main; sys.exit(main())"]


def command(*arguments, cwd=None, **environment):
    """Run the console script's entry point as a process of its own."""
    return subprocess.run(
        [*ENTRY, *map(str, arguments)],
        cwd=cwd,
        env={**os.environ, **environment},
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_programs_commands_and_exit_codes_pass_through(tmp_path, litz_program):
    direct = subprocess.run([litz_program, "--version"], capture_output=True, text=True, check=True)
    assert command("--version").stdout == direct.stdout
    missing = command("check", "missing.inp", cwd=tmp_path)
    assert missing.returncode == 4
    assert "missing.inp" in missing.stderr


def test_help_shows_the_commands_of_both(litz_program):
    direct = subprocess.run([litz_program, "--help"], capture_output=True, text=True, check=True)
    for arguments in (["--help"], ["help"], []):
        shown = command(*arguments)
        assert shown.stdout.startswith(direct.stdout)
        assert "litz plot" in shown.stdout
        assert shown.returncode == 0


@pytest.mark.parametrize("name", ["run", "check", "keywords", "plot", "convert"])
def test_help_about_one_command(name):
    shown = command(name, "--help")
    assert (shown.returncode, shown.stderr) == (0, "")
    assert f"litz {name} " in shown.stdout
    # that of one command, not of all
    assert "litz --version" not in shown.stdout
    assert command("help", name).stdout == shown.stdout
    assert command(name, "wires.inp", "-h").stdout == shown.stdout


def test_help_about_a_command_that_is_none():
    shown = command("help", "rnu")
    assert shown.returncode == 1
    assert shown.stderr.startswith('error: unknown command "rnu"; did you mean litz run? The commands are run, check')


@pytest.mark.parametrize("wrong", [["plto"], ["help", "plto"], ["frobnicate"]])
def test_a_misspelt_command_is_answered_with_all_commands_of_both(litz_program, wrong):
    direct = subprocess.run([litz_program, *wrong], capture_output=True, text=True, check=False)
    through_python = command(*wrong)
    assert direct.returncode == through_python.returncode == 1
    assert direct.stderr == through_python.stderr
    assert ("did you mean litz plot?" in direct.stderr) == ("plto" in wrong)
    of_program, of_package = direct.stderr.split("those of the Python package are")
    for known in ("run", "check", "keywords", "help"):
        assert re.search(rf"\b{known}\b", of_program)
    assert set(re.findall(r"\w+", of_package)) - {"and"} == set(cli.COMMANDS)


def test_the_program_alone_says_where_a_command_of_the_package_is(litz_program):
    direct = subprocess.run([litz_program, "plot", "deck.inp"], capture_output=True, text=True, check=False)
    assert direct.returncode == 1
    assert "litz plot is a command of the Python package" in direct.stderr


def test_the_package_can_be_started_as_a_module():
    shown = subprocess.run([sys.executable, "-m", "litz", "--help"], capture_output=True, text=True, check=True)
    assert shown.stdout == command("--help").stdout


def test_a_reader_that_has_read_enough_is_no_error():
    pipe = subprocess.Popen([*ENTRY, "--help"], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    pipe.stdout.close()
    assert pipe.stderr.read() == b""
    pipe.stderr.close()
    pipe.wait()


def test_summary_of_a_run(run_of_input):
    directory = run_of_input("05_clamped_pair")
    shown = command("summary", directory)
    assert shown.returncode == 0, shown.stderr
    assert "exact electro-mechanical solution" in shown.stdout


def test_what_is_round_off_is_no_result(run_of_input):
    """The wires are back where they were, to some 1e-18 m, and no current flows any more."""
    text = litz.Results(run_of_input("23_dented_wires")).summary()
    assert re.search(r"largest displacement +0 m\n", text)


def test_currents_that_have_ended_have_no_heat(tmp_path):
    model = litz.Model("two crossed wires")
    lower = model.wire("LOWER", (-0.05, 0, 0), (0.05, 0, 0), radius=1e-3, material=litz.COPPER, elements=9)
    upper = model.wire("UPPER", (0, -0.05, 2e-3), (0, 0.05, 2e-3), radius=1e-3, material=litz.COPPER, elements=9)
    model.contact(lower, upper, conductance=litz.HertzSpot())
    model.fix(lower.ends)
    model.fix(upper.ends, "x", "y", "rotations")
    for height, voltage in ((-1e-4, 1e-3), (0.0, 0.0)):
        step = model.step(increment=0.5)
        step.move(upper.ends, "z", height)
        step.potential(lower.start, voltage)
        step.potential(upper.start, 0)
    results = model.run(tmp_path)
    assert 0 < results.field("joule_heat").sum() < 1e-25, "there is no round-off to leave out"
    text = results.summary()
    assert re.search(r"potential +0 V +to 0 V\n", text)
    assert "Joule heat" not in text


def test_the_file_of_contacts_is_not_taken_for_the_results(run_of_input, tmp_path):
    directory = run_of_input("01_crossed_wires")
    beside = directory / "01_crossed_wires_contacts.vtkhdf"
    with pytest.raises(
        litz.FileError, match=r"_contacts.vtkhdf has the contacts of a run .* in .*01_crossed_wires.vtkhdf"
    ):
        litz.Results(beside)
    # a run may have such a name
    for name in ("wires", "wires_contacts"):
        for file in directory.glob("01_crossed_wires.*"):
            (tmp_path / f"{name}{file.suffix}").write_bytes(file.read_bytes())
    assert litz.Results(tmp_path / "wires_contacts.vtkhdf").finished


def test_table_of_a_run(run_of_input):
    shown = command("table", run_of_input("05_clamped_pair"))
    assert shown.returncode == 0, shown.stderr
    heads, units, *rows = shown.stdout.splitlines()
    assert heads.split()[:4] == ["time", "contacts", "contact", "force"]
    assert units.split()[:2] == ["[s]", "[N]"]
    # the start and three levels; the force of the last one is in the deck's head
    assert [row.split()[:2] for row in rows[:4]] == [["0", "0"], ["1", "1"], ["2", "1"], ["3", "1"]]
    assert float(rows[3].split()[2]) == pytest.approx(0.9005914, rel=3e-6)


@pytest.mark.slow
def test_plot_of_a_run(run_of_input, tmp_path):
    picture = tmp_path / "wires.png"
    shown = command("plot", run_of_input("05_clamped_pair"), "-o", picture)
    assert shown.returncode == 0, shown.stderr
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_missing_results_are_an_error_in_words(tmp_path):
    shown = command("summary", tmp_path / "nothing.vtkhdf")
    assert shown.returncode == 4
    assert shown.stderr.startswith("error: ")
    assert "Traceback" not in shown.stderr


def test_wrong_arguments_of_a_python_command_are_input_errors(capsys):
    with pytest.raises(SystemExit) as ended:
        cli.main(["plot"])
    assert ended.value.code == 1
    assert "RESULTS" in capsys.readouterr().err

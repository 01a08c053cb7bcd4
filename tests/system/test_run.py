"""litz.run: the program from Python, its errors as exceptions."""

import signal
import sys

import pytest

import litz


@pytest.fixture
def stand_in(tmp_path, monkeypatch):
    """A program in place of litz: prints its arguments and two messages, ends with the code it is given."""

    def make(exit_code=0, kill=None):
        program = tmp_path / "stand_in"
        end = f"os.kill(os.getpid(), {int(kill)})" if kill else f"sys.exit({exit_code})"
        program.write_text(
            f"#!{sys.executable}\nimport os, sys\n"
            "print('arguments:', *sys.argv[1:])\n"
            "print('error: something is wrong', file=sys.stderr)\n"
            f"sys.stdout.flush(); sys.stderr.flush()\n{end}\n"
        )
        program.chmod(0o755)
        monkeypatch.setenv("LITZ_PROGRAM", str(program))
        return program

    return make


@pytest.mark.parametrize(
    ("exit_code", "error"),
    [
        (1, litz.InputError),
        (2, litz.NotConvergedError),
        (3, litz.SolverError),
        (4, litz.FileError),
        (5, litz.InternalError),
        (6, litz.OutOfMemoryError),
        (77, litz.InternalError),
    ],
)
def test_an_exit_code_becomes_its_exception_with_the_programs_message(stand_in, tmp_path, exit_code, error):
    stand_in(exit_code)
    with pytest.raises(error) as caught:
        litz.run("deck.inp", output_directory=tmp_path)
    assert type(caught.value) is error
    assert isinstance(caught.value, litz.LitzError)
    assert str(caught.value) == "error: something is wrong"
    assert caught.value.results_path is None


def test_results_before_the_failure_are_named(stand_in, tmp_path):
    stand_in(2)
    (tmp_path / "deck.vtkhdf").touch()
    with pytest.raises(litz.NotConvergedError) as caught:
        litz.run("deck.inp", output_directory=tmp_path)
    assert caught.value.results_path == tmp_path / "deck.vtkhdf"


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions have no notes before Python 3.11")
def test_a_run_that_gives_up_says_in_python_what_helps_and_where_its_results_are(inputs, tmp_path):
    deck = (inputs / "01_crossed_wires.inp").read_text(encoding="utf-8")
    # the first increments are too small for 30 of them to reach the end
    deck = deck.replace("INC=200", "INC=30").replace(" 0.1, 3., 1.e-4, 0.1", " 0.01, 3., 1.e-4, 0.1")
    (tmp_path / "deck.inp").write_text(deck)
    with pytest.raises(litz.NotConvergedError) as caught:
        litz.run(tmp_path / "deck.inp", output_directory=tmp_path)
    advice, results = caught.value.__notes__
    assert advice == "In Python: inc=... of Model.step and Model.press."
    with pytest.warns(UserWarning, match="did not finish"):
        kept = eval(results.partition(": ")[2], {"litz": litz})
    assert len(kept.times) == 31
    assert "In Python" not in str(caught.value)


@pytest.mark.skipif(sys.version_info < (3, 11), reason="exceptions have no notes before Python 3.11")
def test_results_of_an_earlier_run_are_not_said_to_be_those_of_one_that_gave_up(stand_in, tmp_path):
    stand_in(2)
    (tmp_path / "deck.vtkhdf").touch()
    with pytest.raises(litz.NotConvergedError) as caught:
        litz.run("deck.inp", output_directory=tmp_path)
    assert not hasattr(caught.value, "__notes__")


def test_a_crash_is_an_internal_error_that_names_the_signal(stand_in, tmp_path):
    stand_in(kill=signal.SIGSEGV)
    with pytest.raises(litz.InternalError, match=f"signal {int(signal.SIGSEGV)}"):
        litz.run("deck.inp", output_directory=tmp_path)


def test_options_are_passed_on_and_output_is_shown_on_request(stand_in, tmp_path, capsys):
    stand_in(1)
    with pytest.raises(litz.InputError):
        litz.run("deck.inp", output_directory=tmp_path, solver="skyline", threads=2, restart="old.h5:1:3", quiet=False)
    words = f"arguments: run deck.inp -o {tmp_path} --solver skyline --threads 2 --restart old.h5:1:3\n"
    assert capsys.readouterr().out == words


def test_a_quiet_run_prints_nothing(stand_in, tmp_path, capfd):
    stand_in(1)
    with pytest.raises(litz.InputError):
        litz.run("deck.inp", output_directory=tmp_path)
    assert capfd.readouterr() == ("", "")


def test_a_model_is_told_how_it_runs():
    with pytest.raises(TypeError, match=r"not Model: a model has its own `run\(directory\)`"):
        litz.run(litz.Model("of no wires"))


def test_a_missing_program_is_said_in_words(monkeypatch, tmp_path):
    monkeypatch.setenv("LITZ_PROGRAM", str(tmp_path / "nowhere"))
    with pytest.raises(litz.FileError, match="LITZ_PROGRAM"):
        litz.run("deck.inp")


def test_a_wrong_deck_raises_the_programs_own_message(tmp_path):
    deck = tmp_path / "wrong.inp"
    deck.write_text("*HEADING\nwrong\n*NODES\n1, 0., 0., 0.\n")
    with pytest.raises(litz.InputError, match=r"wrong\.inp:3:1"):
        litz.run(deck, output_directory=tmp_path)


def test_results_of_a_run_come_back(inputs, tmp_path):
    results = litz.run(inputs / "05_clamped_pair.inp", output_directory=tmp_path / "new" / "directory")
    assert isinstance(results, litz.Results)
    assert results.path == tmp_path / "new" / "directory" / "05_clamped_pair.vtkhdf"
    assert results.finished

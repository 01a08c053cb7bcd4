"""What the documents say can be done, works: every block of code in them is tried out (tests/documents.py)."""

import doctest
import os
import re
import subprocess
import sys
from dataclasses import replace
from importlib import import_module

import pytest

import litz as litz_package
from documents import LANGUAGES, ROOT, blocks, documents, setup_commands

DOCUMENTS = documents()
BLOCKS = [block for document in DOCUMENTS for block in blocks(document)]
# a page whose blocks change the sources has a test of its own: test_new_spot_law.py
PAGES_THAT_RUN = sorted(
    {block.document for block in BLOCKS if block.language in ("python", "sh")} - {ROOT / "docs" / "new_spot_law.md"}
)
NAMES = {path: str(path.relative_to(ROOT)) for path in DOCUMENTS}


def in_language(language):
    """Test once for each block of a language that can be tried out."""
    chosen = [block for block in BLOCKS if block.language == language and not block.not_run]
    return pytest.mark.parametrize("block", chosen, ids=lambda block: block.place)


def test_blocks_are_found():
    # the tests below would pass on empty lists
    assert {"python", "sh", "inp", "fortran", "output"} <= {block.language for block in BLOCKS}
    assert ROOT / "README.md" in PAGES_THAT_RUN


def test_every_block_says_what_it_is():
    unknown = [
        f"{block.place}: {block.language or 'no language'}" for block in BLOCKS if block.language not in LANGUAGES
    ]
    assert not unknown, f"allowed are {sorted(LANGUAGES)}"


def test_no_fence_is_overlooked():
    for document in DOCUMENTS:
        fences = re.findall(r"^ *`{3,}", document.read_text(encoding="utf-8"), re.MULTILINE)
        directives = re.findall(r"^ *`{3,}\{", document.read_text(encoding="utf-8"), re.MULTILINE)
        assert len(fences) == 2 * (len(blocks(document)) + len(directives)), NAMES[document]


@pytest.mark.parametrize("document", DOCUMENTS, ids=NAMES.get)
def test_links_lead_somewhere(document):
    links = re.findall(r"\]\((?!https?:)([^)\s]*)\)", without_blocks(document))
    missing = []
    for link in links:
        path, _, anchor = link.partition("#")
        target = document.parent / path if path else document
        if not target.exists() or (anchor and anchor not in anchors(target)):
            missing.append(link)
    assert not missing


def without_blocks(document):
    """The text of a document without its fenced blocks, where brackets mean something else."""
    return re.sub(r"^( *)(`{3,}).*?^\1\2", "", document.read_text(encoding="utf-8"), flags=re.MULTILINE | re.DOTALL)


def anchors(document):
    """What `#...` may follow the name of a document, by the rule of the usual readers of Markdown."""
    titles = re.findall(r"^#+ (.*)$", without_blocks(document), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.lower()).strip().replace(" ", "-") for title in titles}


@pytest.fixture
def workplace(tmp_path, litz_program, contact_element):
    """A folder as documents assume it: decks in inputs, the contact element in build/fortran, `litz` on the path.

    Returned with the environment for processes in it.
    """
    (tmp_path / "inputs").symlink_to(ROOT / "inputs")
    (tmp_path / "build").mkdir()
    (tmp_path / "build" / "fortran").symlink_to(contact_element.parent)
    commands = tmp_path / ".commands"
    commands.mkdir()
    code = "import sys; from litz.cli import main; sys.exit(main())"
    (commands / "litz").write_text(f"#!/bin/sh\nexec '{sys.executable}' -c '{code}' \"$@\"\n")
    (commands / "litz").chmod(0o755)
    (commands / "python").symlink_to(sys.executable)
    environment = {
        **os.environ,
        "PATH": f"{commands}{os.pathsep}{os.environ['PATH']}",
        "LITZ_PROGRAM": str(litz_program),
        "PYTHONPATH": os.pathsep.join(map(str, sys.path)),
        "PYTHONWARNINGS": "error::UserWarning",
    }
    return tmp_path, environment


@pytest.mark.parametrize("document", PAGES_THAT_RUN, ids=NAMES.get)
def test_python_and_commands_run_and_print_what_they_should(document, workplace):
    folder, environment = workplace
    python = PythonSession(folder, environment)
    try:
        printed = None
        for block in blocks(document):
            if block.language == "output":
                assert printed is not None, f"{block.place}: there is nothing before it that prints"
                assert same_output(block.text, printed), f"{block.place}: printed was\n{printed}"
                continue
            printed = None
            if block.saved_as:
                (folder / block.saved_as).write_text(block.text)
            if block.not_run or setup_commands(block) is not None:
                continue
            if block.language == "python":
                printed = python.run(block)
            elif block.language == "sh":
                printed = run_shell(block, folder, environment)
    finally:
        python.close()
    pictures = re.findall(r"!\[[^\]]*\]\(\.\./pictures/([^)]+)\)", document.read_text(encoding="utf-8"))
    made = {path.name for path in folder.rglob("*.png")}
    assert set(pictures) <= made, f"{NAMES[document]} shows pictures that its blocks do not make"


def same_output(wanted, printed):
    options = doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE
    return doctest.OutputChecker().check_output(wanted, printed, options)


def run_shell(block, folder, environment):
    done = subprocess.run(
        ["bash", "-e", "-o", "pipefail", "-c", block.text],
        cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300, check=False,
    )  # fmt: skip
    assert done.returncode == 0, f"{block.place}: {done.stdout}{done.stderr}"
    return done.stdout


class PythonSession:
    """An interpreter that runs one block after another."""

    _END = "end of the block"
    _LOOP = f"""
import sys, traceback
names = {{"__name__": "__main__"}}
while size := sys.stdin.readline():
    text = sys.stdin.read(int(size))
    try:
        exec(compile(text, "block", "exec"), names)
        word = "done"
    except BaseException:
        traceback.print_exc(file=sys.stdout)
        word = "failed"
    print("\\n{_END}", word, flush=True)
"""

    def __init__(self, folder, environment):
        self._process = subprocess.Popen(
            [sys.executable, "-c", self._LOOP],
            cwd=folder, env=environment, text=True, stdin=subprocess.PIPE, stdout=subprocess.PIPE,
        )  # fmt: skip

    def run(self, block):
        self._process.stdin.write(f"{len(block.text)}\n{block.text}")
        self._process.stdin.flush()
        printed = []
        for line in self._process.stdout:
            if line.startswith(self._END):
                assert line.split()[-1] == "done", f"{block.place}: {''.join(printed)}"
                return "".join(printed)
            printed.append(line)
        raise AssertionError(f"{block.place}: the interpreter ended. {''.join(printed)}")

    def close(self):
        self._process.stdin.close()
        self._process.stdout.close()
        self._process.wait(timeout=60)


def test_a_failing_block_is_noticed(workplace):
    (block, *_) = [block for block in BLOCKS if block.language == "python"]
    session = PythonSession(*workplace)
    try:
        with pytest.raises(AssertionError, match="ZeroDivisionError"):
            session.run(replace(block, text="1/0\n"))
    finally:
        session.close()


@pytest.mark.parametrize("block", [b for b in BLOCKS if setup_commands(b) is not None], ids=lambda block: block.place)
def test_the_commands_of_setup_exist(block):
    shown = subprocess.run(["bash", ROOT / "setup", "help"], capture_output=True, text=True, check=True).stdout
    known = set(re.findall(r"^  \./setup (\w*)", shown, re.MULTILINE))
    assert set(setup_commands(block)) <= known


@in_language("inp")
def test_decks_are_accepted(block, litz, tmp_path):
    (tmp_path / "deck.inp").write_text(block.text)
    done = litz("check", "deck.inp", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.fixture(scope="session")
def contact_element(build_target):
    """The contact element in one file."""
    return build_target("fortran/contact_element.f90")


@in_language("fortran")
def test_fortran_compiles_without_a_warning(block, contact_element, tmp_path):
    (tmp_path / "block.f90").write_text(block.text)
    command = [
        "gfortran",
        "-std=f2008",
        "-Wall",
        "-Wextra",
        "-Wno-maybe-uninitialized",
        "-c",
        contact_element,
        "block.f90",
    ]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, ""), f"{block.place}: {done.stderr}"


def test_the_deck_of_the_readme_runs(tmp_path, litz):
    (block,) = [block for block in blocks(ROOT / "README.md") if block.language == "inp"]
    (tmp_path / "deck.inp").write_text(block.text)
    done = litz("run", "deck.inp", cwd=tmp_path)
    assert done.returncode == 0, done.stdout + done.stderr
    assert (tmp_path / "deck.vtkhdf").is_file()


def test_the_deck_reference_is_what_the_program_prints(litz):
    printed = litz("keywords", "--markdown")
    assert printed.returncode == 0, printed.stderr
    assert (ROOT / "docs" / "deck_reference.md").read_text(encoding="utf-8") == printed.stdout


@pytest.mark.parametrize("name", litz_package.__all__)
def test_every_public_name_is_in_the_python_reference(name):
    page = (ROOT / "docs" / "python_reference.md").read_text(encoding="utf-8")
    modules = [sys.modules[module] for module in re.findall(r"automodule:: (\S+)", page) if import_module(module)]
    named = re.findall(r"auto\w+:: litz\.(\w+)", page)
    assert name in named or any(name in module.__all__ for module in modules)


MODULES = sorted(path.relative_to(ROOT / "python") for path in (ROOT / "python" / "litz").rglob("*.py"))


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_the_examples_of_docstrings_hold(module, run_of_input, tmp_path, monkeypatch):
    __import__(name := ".".join(module.with_suffix("").parts).removesuffix(".__init__"))
    monkeypatch.chdir(tmp_path)
    for path in run_of_input("01_crossed_wires").iterdir():
        (tmp_path / path.name).symlink_to(path)
    failed, _ = doctest.testmod(sys.modules[name], optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    assert failed == 0

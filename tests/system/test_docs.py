"""What the documents say can be done, works: every block of code in them is tried out (tests/documents.py)."""

import ast
import doctest
import inspect
import os
import re
import subprocess
import sys
from dataclasses import replace
from importlib import import_module

import pytest

import litz as litz_package
from documents import LANGUAGES, ROOT, blocks, documents, setup_commands
from new_things import PAGES

DOCUMENTS = documents()
BLOCKS = [block for document in DOCUMENTS for block in blocks(document)]
# pages whose blocks change the sources have a test of their own, which compiles them: test_new_things.py
PAGES_OF_CHANGES = {ROOT / "docs" / page for page in PAGES}
PAGES_THAT_RUN = sorted({block.document for block in BLOCKS if block.language in ("python", "sh")} - PAGES_OF_CHANGES)
NAMES = {path: str(path.relative_to(ROOT)) for path in DOCUMENTS}


def in_language(language, pages_left_out=frozenset()):
    """Test once for each block of a language that can be tried out."""
    in_question = [block for block in BLOCKS if block.document not in pages_left_out]
    chosen = [block for block in in_question if block.language == language and not block.not_run]
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


WITH_EQUATIONS = [document for document in DOCUMENTS if re.search(r"^`{3}math$", document.read_text("utf-8"), re.M)]


def inline_equations(document):
    """What stands between dollars in the text of a document."""
    text = re.sub(r"`[^`]*`", "", without_blocks(document))
    return re.findall(r"\$([^$]+)\$", text)


@pytest.mark.parametrize("document", WITH_EQUATIONS, ids=NAMES.get)
def test_readers_of_markdown_leave_inline_equations_as_they_are(document):
    # many, GitHub's too, look for emphasis, escapes and columns of tables before they look for equations
    taken = {r"\\[^A-Za-z]": "an escape", r"[^\w\s]_": "emphasis", r"\|": "a column", r"\*": "emphasis"}
    wrong = [(tex, what) for tex in inline_equations(document) for mark, what in taken.items() if re.search(mark, tex)]
    assert not wrong


@pytest.mark.parametrize("document", WITH_EQUATIONS, ids=NAMES.get)
def test_equations_are_whole(document):
    displayed = [block.text for block in blocks(document) if block.language == "math"]
    for tex in displayed + inline_equations(document):
        plain = re.sub(r"\\[{}]", "", tex)
        assert plain.count("{") == plain.count("}"), tex
        assert len(re.findall(r"\\left\b", tex)) == len(re.findall(r"\\right\b", tex)), tex
        assert sorted(re.findall(r"\\begin{(\w+)}", tex)) == sorted(re.findall(r"\\end{(\w+)}", tex)), tex
    # \\ would have Sphinx wrap the equation in an environment that cannot have a number; \cr ends a row, too
    assert not [tex for tex in displayed if r"\\" in tex]


def test_the_equations_of_the_theory_are_numbered_and_those_that_are_cited_are_there():
    theory = ROOT / "docs" / "theory.md"
    numbers = [tuple(map(int, tag)) for tag in re.findall(r"\\tag{(\d+)\.(\d+)}", theory.read_text("utf-8"))]
    assert numbers == sorted(set(numbers))
    assert all(number[1] == 1 or (number[0], number[1] - 1) in numbers for number in numbers)
    cited = re.findall(r"\((\d+\.\d+)\)", without_blocks(theory))
    assert cited
    assert {tuple(map(int, number.split("."))) for number in cited} <= set(numbers)


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


#: They run or compile what takes ten seconds or minutes
SLOW_PAGES = {
    ROOT / "docs" / name
    for name in (
        "from_python.md",
        "results.md",
        "user_element.md",
        *(
            f"tutorials/{page}.md"
            for page in ("current_sharing", "fibre_mat", "cable", "nanowire_film", "contact_zones")
        ),
    )
}


@pytest.mark.parametrize(
    "document",
    [pytest.param(page, marks=pytest.mark.slow) if page in SLOW_PAGES else page for page in PAGES_THAT_RUN],
    ids=NAMES.get,
)
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
    made = {path.name for path in folder.rglob("*.png")} | made_of_decks()
    assert set(pictures) <= made, f"{NAMES[document]} shows pictures that its blocks do not make"


def made_of_decks():
    """Pictures of decks in `inputs`, by the script that makes all."""
    script = (ROOT / "docs" / "site" / "pictures.py").read_text(encoding="utf-8")
    return set(re.findall(r'^    PICTURES / "([^"]+)": \($', script, re.MULTILINE))


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


def test_the_contact_element_in_one_file_says_what_it_is_and_under_which_licence(contact_element):
    head = contact_element.read_text(encoding="utf-8").split("\nmodule ")[0]
    words = " ".join(re.sub(r"^!>? ?", "", head, flags=re.MULTILINE).split())
    version = re.search(r"version: '([^']+)'", (ROOT / "meson.build").read_text(encoding="utf-8"))[1]
    assert words.startswith(f"The contact element of litz {version}")
    assert " ".join((ROOT / "LICENSE").read_text(encoding="utf-8").split()) in words


@pytest.mark.slow
@in_language("fortran", PAGES_OF_CHANGES)
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


def test_the_deck_that_is_shown_runs(tmp_path, litz):
    (block,) = [block for block in blocks(ROOT / "docs" / "decks.md") if block.language == "inp"]
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
def test_each_number_of_a_result_is_explained(module):
    # without a comment of its own, the reference calls a field "Alias for field number 3"
    lines = (ROOT / "python" / module).read_text(encoding="utf-8").splitlines()
    tuples = [
        node
        for node in ast.walk(ast.parse("\n".join(lines)))
        if isinstance(node, ast.ClassDef) and "NamedTuple" in map(ast.unparse, node.bases)
    ]
    fields = [field for node in tuples for field in node.body if isinstance(field, ast.AnnAssign)]
    assert not [ast.unparse(field) for field in fields if not lines[field.lineno - 2].lstrip().startswith("#:")]


def test_help_names_types_as_the_sources_do():
    # numpy's array_like, spelt out, is ten times as long as what help() has to say
    functions = [
        function
        for module in (litz_package.kernels, litz_package.closed_forms, litz_package.build, litz_package.Model)
        for _, function in inspect.getmembers(module, inspect.isfunction)
    ]
    assert len(functions) > 30
    assert not [function.__name__ for function in functions if "_SupportsArray" in str(inspect.signature(function))]


@pytest.mark.parametrize("module", MODULES, ids=str)
def test_the_examples_of_docstrings_hold(module, run_of_input, tmp_path, monkeypatch):
    __import__(name := ".".join(module.with_suffix("").parts).removesuffix(".__init__"))
    monkeypatch.chdir(tmp_path)
    for path in run_of_input("01_crossed_wires").iterdir():
        (tmp_path / path.name).symlink_to(path)
    failed, _ = doctest.testmod(sys.modules[name], optionflags=doctest.ELLIPSIS | doctest.NORMALIZE_WHITESPACE)
    assert failed == 0

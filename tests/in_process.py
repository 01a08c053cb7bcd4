"""Commands of the Python package in the process of the tests: a process of its own would load numpy anew for each."""

import contextlib
import io
import os
import subprocess
import warnings
from pathlib import Path

from litz.cli import COMMANDS, main


def command(*arguments, cwd=None):
    """What `litz ARGUMENTS` answers, as a finished process."""
    assert arguments[0] in COMMANDS, "commands of the program replace the process"
    out, err, before = io.StringIO(), io.StringIO(), Path.cwd()
    os.chdir(cwd or before)
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err), warnings.catch_warnings():
            code = main(list(map(str, arguments)))
    except SystemExit as end:
        code = end.code
    finally:
        os.chdir(before)
    return subprocess.CompletedProcess(arguments, code, out.getvalue(), err.getvalue())

"""Seconds that a command pays before it begins: `import contactkit` over an empty interpreter."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize("code", ["pass", "import contactkit", "import contactkit.cli"])
def test_import_in_a_fresh_interpreter(benchmark, code):
    """The first is the interpreter alone."""
    benchmark(subprocess.run, [sys.executable, "-c", code], check=True)

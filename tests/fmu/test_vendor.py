"""Which files an FMU carries: those its slave imports, at once or later, and no others."""

from __future__ import annotations

import re
import sys

import pytest

from contactkit.errors import ContactkitError
from contactkit.fmu.python.vendor import bundled_attrs, find_closure


def test_only_what_the_slave_imports_is_carried(toy_module):
    closure = find_closure("contactkit.fmu.slaves.toy_slave")
    assert {path for path in closure.sources if not path.startswith("bundled/")} == {
        "__init__.py",
        "errors.py",
        "fmu/__init__.py",
        "fmu/framework/__init__.py",
        "fmu/framework/access.py",
        "fmu/framework/description.py",
        "fmu/framework/places.py",
        "fmu/framework/ports.py",
        "fmu/framework/slave.py",
        "fmu/framework/state.py",
        "fmu/framework/tables.py",
        "fmu/slaves/__init__.py",
        "fmu/slaves/toy_slave.py",
        "units.py",
        "validators.py",
    }
    assert closure.requires == set()
    assert b"import" not in closure.sources["__init__.py"]


@pytest.fixture
def package(tmp_path, monkeypatch):
    """A package to find imports in."""
    files = {
        "pack/__init__.py": "from .heavy import everything",
        "pack/heavy.py": "import scipy",
        "pack/a.py": (
            "from typing import TYPE_CHECKING\nimport os.path\nfrom . import b\n"
            "if TYPE_CHECKING:\n    from . import unseen\nelse:\n    from .sub import c\n"
            "def later():\n    from .sub.d import x\n    import numpy as np\n"
        ),
        "pack/b.py": "",
        "pack/unseen.py": "",
        "pack/sub/__init__.py": "from .c import name\n",
        "pack/sub/c.py": "name = 1\n",
        "pack/sub/d.py": "from .. import b\n",
        "pack/uses_init.py": "from .sub import name",
        "pack/absolute.py": "import pack.b",
        "pack/broken.py": "from . import b\nfrom .gone import x",
    }
    for path, text in files.items():
        target = tmp_path / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.setitem(sys.modules, "pack.heavy", type(sys)("pack.heavy"))
    sys.modules["pack.heavy"].everything = None
    yield
    for name in [name for name in sys.modules if name.partition(".")[0] == "pack"]:
        del sys.modules[name]


def test_closure_follows_every_kind_of_import(package):
    closure = find_closure("pack.a")
    assert set(closure.sources) == {
        "__init__.py",
        "a.py",
        "b.py",
        "sub/__init__.py",
        "sub/c.py",
        "sub/d.py",
    }
    assert closure.requires == {"numpy"}
    assert find_closure("pack.a", at_once=True).requires == set()
    assert b"import" not in closure.sources["sub/__init__.py"]
    assert b"import" in find_closure("pack.uses_init").sources["sub/__init__.py"]


def test_closure_refuses_what_cannot_be_carried(package):
    with pytest.raises(ContactkitError, match="imports 'pack' by name; make the import relative"):
        find_closure("pack.absolute")
    with pytest.raises(ContactkitError, match=r"needs module pack\.gone, which does not exist"):
        find_closure("pack.broken")


def test_all_of_attrs_is_in_the_package_and_imports_itself_only():
    files = bundled_attrs()
    assert {f"bundled/{path}" for path in ("attr/_make.py", "attrs/__init__.py")} <= set(files)
    closure = find_closure("contactkit.fmu.slaves.toy_slave")
    assert files.items() <= closure.sources.items()
    for path, source in closure.sources.items():
        assert not re.search(rb"^\s*(from|import) attrs?\b", source, re.MULTILINE), path

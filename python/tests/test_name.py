"""The module beside the robotics library `pinocchio` (PyPI: pin)."""
import importlib.metadata
import importlib.util
import pathlib
import subprocess
import sys

import pinocchio_renderer as pn
import pytest


def test_nothing_of_the_other_packages_name_is_installed():
    try:
        files = importlib.metadata.files("pinocchio-renderer")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("the module is not installed")
    tops = {file.parts[0] for file in files if file.parts[0] != ".."}
    assert all(top == "pinocchio_renderer" or top.startswith("pinocchio_renderer-") for top in tops), tops
    assert {file.parts[-1] for file in files} >= {"__init__.py", "_core.pyi", "py.typed"}


def test_both_are_imported(tmp_path):
    # A stand-in: the real one is 50 MB.
    (tmp_path / "pinocchio").mkdir()
    (tmp_path / "pinocchio/__init__.py").write_text("class Model: pass\n")
    code = (
        "import pinocchio as pin, pinocchio_renderer as pn\n"
        "assert not hasattr(pin, 'Engine') and not hasattr(pn, 'Model')\n"
        "print(pin.__file__, pn.__file__)\n"
    )
    run = subprocess.run([sys.executable, "-c", code], cwd=tmp_path, capture_output=True, text=True, check=True)
    theirs, ours = map(pathlib.Path, run.stdout.split())
    assert theirs.parent == tmp_path / "pinocchio" and ours.parent == pathlib.Path(pn.__file__).parent


def test_our_module_is_not_called_pinocchio():
    found = importlib.util.find_spec("pinocchio")
    assert found is None or pathlib.Path(pn.__file__).parent not in pathlib.Path(found.origin).parents
    assert {value.__module__ for value in (pn.Scene, pn.Engine)} == {"pinocchio_renderer._core"}

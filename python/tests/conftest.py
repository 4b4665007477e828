import os
import pathlib

import pytest

# The tree that holds the scenes, and the program (a build folder's), where there is one.
TREE = pathlib.Path(__file__).resolve().parents[2]


@pytest.fixture
def scenes():
    return TREE / "scenes"


@pytest.fixture
def program():
    path = os.environ.get("PINOCCHIO_PROGRAM")
    if not path:
        pytest.skip("PINOCCHIO_PROGRAM does not name the program")
    return path

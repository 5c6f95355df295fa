"""Check the package with the linters of ROS."""

from ament_flake8.main import main_with_errors
from ament_pep257.main import main as pep257
import pytest


@pytest.mark.flake8
@pytest.mark.linter
def test_flake8():
    """Find no fault in the style of the code."""
    status, errors = main_with_errors(argv=[])
    assert status == 0, '\n'.join(errors)


@pytest.mark.linter
@pytest.mark.pep257
def test_pep257():
    """Find no fault in the docstrings."""
    assert pep257(argv=['.', 'test']) == 0

"""The pytest plugin: which notebooks are tests, and how strictly they are compared.

`pytest` alone runs both trees with everything else, `solutions/` strict and `notebooks/` lax.
nbval's own options work as they always do, for these and any other notebook.
"""

from __future__ import annotations

from collections.abc import Generator
from pathlib import Path

import pytest
from nbval.plugin import IPyNbFile

from notebooks.page import Page

STRICT_BY_TREE = {"solutions": True, "notebooks": False}
NBVAL_TIMEOUT = 2000
CELL_TIMEOUT = 60.0


def pytest_configure(config: pytest.Config) -> None:
    """Shorten nbval's half an hour, and let a plain `pytest` find the pages."""
    if config.option.nbval_cell_timeout == NBVAL_TIMEOUT:
        config.option.nbval_cell_timeout = CELL_TIMEOUT
    if config.args_source == pytest.Config.ArgsSource.TESTPATHS:
        trees = [str(config.rootpath / name) for name in STRICT_BY_TREE]
        config.args += [tree for tree in trees if Path(tree).is_dir() and tree not in config.args]


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(
    file_path: Path, parent: pytest.Collector
) -> Generator[None, list[pytest.Collector], list[pytest.Collector]]:
    """Put our page in the place of nbval's."""
    collectors = yield
    others = [collector for collector in collectors if type(collector) is not IPyNbFile]
    strict = strictness(file_path, parent.config)
    if file_path.suffix != ".ipynb" or strict is None:
        return others
    page = Page.from_parent(parent, path=file_path)
    page.compare_outputs = strict
    return [*others, page]


def strictness(path: Path, config: pytest.Config) -> bool | None:
    """Whether a notebook's outputs are compared; nothing if it is no test at all."""
    if config.option.nbval or config.option.nbval_lax:
        return not config.option.nbval_lax
    if path.parent.parent == config.rootpath:
        return STRICT_BY_TREE.get(path.parent.name)
    return None

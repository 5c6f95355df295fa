"""A page as a test: nbval's file and cells, with the holes closed."""

from __future__ import annotations

from collections.abc import Iterator
from queue import Empty
from typing import Any, NoReturn

import pytest
from nbval.plugin import IPyNbCell, IPyNbFile

from notebooks.built import Ran, difference, source_of
from notebooks.comparison import Watch, comparable, missing_outputs, wrong_outcome
from notebooks.kernel import KernelDiedError, WatchedKernel
from rosbeat.errors import LessonError
from rosbeat.exercises.registry import EXERCISES

_OUTPUT_TIMEOUT = 10
# How long a thread that died with the last cell has to say so.
_SILENCE = 0.3


class Page(IPyNbFile):
    """A notebook whose cells run one after the other in a kernel of their own."""

    kernel: WatchedKernel | None = None

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.watch = Watch()
        self.runs: dict[int, Ran] = {}
        self.ran = Ran()

    def collect(self) -> Iterator[pytest.Item]:
        cells = list(super().collect())
        if self.compare_outputs:
            yield StoredOutputs.from_parent(self, name="stored outputs")
        for cell in cells:
            yield Cell.from_parent(
                self, name=cell.name, cell_num=cell.cell_num, cell=cell.cell, options=cell.options
            )
        if self.compare_outputs and source_of(self.path):
            yield AsBuilt.from_parent(self, name="as it is built")
        yield EndOfPage.from_parent(self, name="end of the page")

    def setup(self) -> None:
        timeout = self.config.option.nbval_kernel_startup_timeout
        self.kernel = WatchedKernel(str(self.path.parent), timeout, self.path.name)
        self.setup_sanitize_files()

    def teardown(self) -> None:
        # nbval stops only kernels that are alive, and keeps the sockets of dead ones.
        if self.kernel is not None:
            self.kernel.stop()

    def get_kernel_message(self, timeout: float | None = None, stream: str = "iopub") -> Any:
        message = super().get_kernel_message(timeout, stream)
        self.watch.see(message)
        if self.kernel and message["parent_header"].get("msg_id") == self.kernel.asked:
            self.ran.see(message)
        return message


class Cell(IPyNbCell):
    """A code cell; beyond nbval's comparison, nothing may go wrong unseen."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.output_timeout = _OUTPUT_TIMEOUT

    def runtest(self) -> None:
        self.parent.watch.replaced = ""
        self.parent.runs[self.cell_num] = self.parent.ran = Ran()
        try:
            super().runtest()
        except KernelDiedError as death:
            self.raise_cell_error(str(death))
        for problem in self.problems():
            self.raise_cell_error(problem)

    def problems(self) -> Iterator[str]:
        """What nbval would let pass."""
        raised = any(output.output_type == "error" for output in self.test_outputs)
        if self.options["check_exception"] and not raised:
            yield "The cell is to raise an exception, and raised none"
        if self.parent.kernel.reply.get("status") == "error" and not raised:
            yield "The kernel reports an error without a message, as of a wrongly called magic"
        if self.parent.watch.replaced:
            yield f"The cell replaces outputs ({self.parent.watch.replaced}): not comparable"
        background = self.parent.watch.background_exception()
        if background:
            yield f"An exception in the background, of this cell or one before it:\n{background}"
        surprise = wrong_outcome(self.cell, self.test_outputs, solved=self.parent.compare_outputs)
        if surprise:
            yield surprise

    def compare_outputs(self, test: Any, ref: Any, skip_compare: Any = None) -> bool:
        return super().compare_outputs(comparable(test), comparable(ref), skip_compare)


class PageItem(pytest.Item):
    """A statement about a page as a whole."""

    def fail(self, message: str) -> NoReturn:
        """Fail with a message and no traceback, which would show only this plugin."""
        pytest.fail(f"{self.path.name}: {message}", pytrace=False)

    def reportinfo(self) -> tuple[Any, int, str]:
        return self.path, 0, self.name


class StoredOutputs(PageItem):
    """A page without outputs would pass every comparison."""

    def runtest(self) -> None:
        problem = missing_outputs(self.parent.nb.cells)
        if problem:
            self.fail(f"{problem} Nothing can be compared; build the page with its outputs.")


class AsBuilt(PageItem):
    """What was just run is what the page stores, as `rosbeat build --check` would find."""

    def runtest(self) -> None:
        points = {one.id: one.points for one in EXERCISES.values()}
        runs = [self.parent.runs[number] for number in sorted(self.parent.runs)]
        try:
            change = difference(self.path, source_of(self.path), runs, points)
        except (LessonError, ValueError) as error:
            self.fail(f"it could not be built of this run: {error}")
        if change:
            self.fail(f"a build would change it.\n{change.diff}")


class EndOfPage(PageItem):
    """Nothing is left behind: no dying thread, no kernel that aborts when it ends."""

    def runtest(self) -> None:
        self.drain()
        background = self.parent.watch.background_exception()
        if background:
            self.fail(f"an exception in the background:\n{background}")
        if not self.parent.kernel.is_alive():
            self.fail("the kernel did not live to the end of the page.")
        code = self.parent.kernel.leave()
        if code != 0:
            self.fail(f"the kernel ended with code {code}. {self.parent.kernel.last_words()}")

    def drain(self) -> None:
        """Read what still comes after the last cell."""
        if not self.parent.kernel.is_alive():
            return
        while True:
            try:
                self.parent.get_kernel_message(timeout=_SILENCE)
            except Empty:
                return

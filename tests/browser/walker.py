"""Somebody who goes through a page by its buttons, makes mistakes, and does what messages say."""

import json
import re
import time
from contextlib import suppress
from urllib.parse import unquote

from playwright.sync_api import TimeoutError as Late
from playwright.sync_api import expect

from bank.conftest import FOLDER
from bank.reading import answers
from bank.workspaces import EXERCISES as DONE_BY_HAND
from bank.workspaces import SAVED_ON, Desk
from browser.notebook import PATIENCE, SHOWN, Notebook
from rosbeat.exercises.quiz import QUESTIONS
from rosbeat.workspace.prerequisites import PACKAGE, finished

#: What stands above an answer of the bank in its cell, for those that are no whole cells.
ABOVE = {
    **dict.fromkeys(("01a", "06a", "06b"), '%%terminal {terminal}\ncd "$ROS2_WORKSPACE"\n'),
    "01b": '%%terminal {terminal}\ncd "$ROS2_WORKSPACE/resources/images"\n',
    "02b": '%%terminal {terminal}\ncd "$ROS2_WORKSPACE"\n',
    "02a": "%%save src/sensor_simulator/package.xml\n",
    "05a": "%%save src/sensor_simulator/setup.py\n",
    "05b": "%%save src/lamp_control/setup.py\n",
}
#: Builds are not in the bank, which has what a build leaves.
OWN = {"06b": ('cd "$ROS2_WORKSPACE/src"\ncolcon build --symlink-install',)}
#: These wait for a deadline.
SLOW = {"callback-blocks", "constructor-blocks", "exits"}
#: A command that a message gives, to be typed as it stands.
COMMAND = re.compile(r'(?:cd|rm|mv|touch|sed) .*"\$ROS2_WORKSPACE"')
#: One that a remark of a terminal gives.
SAID = re.compile(r'((?:cd|source) [\w./]*"\$ROS2_WORKSPACE[\w./]*"(?:/[\w/]+)?)')
#: More cells than this in a row are not a way that a message shows.
MOST_STEPS = 12
#: What stands below a command that failed, or went wrong without an error.
FAILED = re.compile(r"# exit code [1-9]|# .*\$ROS2_WORKSPACE")
GONE = {"quiz(": "The choices went with the kernel.", "predict(": "The field to predict went"}


def wrong_tries(exercise):
    """The bank's wrong answers that are tried on a page, each the text of a cell's answer."""
    if exercise in OWN:
        return OWN[exercise]
    usual = next(one for one in answers() if one.exercise == exercise).subject
    return tuple(
        one.text
        for one in answers()
        if (one.exercise, one.status) == (exercise, "failed")
        and (exercise in DONE_BY_HAND or one.subject == usual)
        and not (one.before or "____" in one.text or SLOW & set(one.mistakes))
    )


def code_cells(path):
    """The code cells of a page, as its file has them."""
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    return [one for one in cells if one["cell_type"] == "code"]


class Walker:
    """Go through one page.

    Args:
        page: Playwright's page.
        lab: The server.
        name: The page's file.
    """

    def __init__(self, page, lab, name):
        self.page, self.lab, self.name = page, lab, name
        self.notebook = Notebook(page, lab, name)
        self.cells = code_cells(lab.root / name)
        self.solved = code_cells(lab.root / "solutions" / name)
        self.ids = [one["id"] for one in self.cells]
        self.sources = ["".join(one["source"]) for one in self.cells]
        #: Each message that a cell has raised, and what was done about it.
        self.messages = []
        #: The exercises that were passed.
        self.passed = []
        #: What each prediction was answered with.
        self.outcomes = {}
        #: The cells with a quiz or a prediction that wait for an answer.
        self.open = set()

    def about(self, number, what):
        """What the lesson says of a cell, such as its `exercise`."""
        return self.cells[number]["metadata"].get("rosbeat", {}).get(what)

    def exercise_of(self, number):
        """The exercise that a cell answers or checks; None if none, as for the whole system."""
        found = self.about(number, "exercise") or self.about(number, "check")
        return None if found == "system" else found

    # Cells.

    def run(self, number, steps=0, is_wrong=False):
        """Run a cell, and as often as it names another one that one first.

        Args:
            number: The cell's number.
            steps: How many cells have led here.
            is_wrong: Whether it has a wrong answer, so that its commands may fail.
        """
        assert steps < MOST_STEPS, self.messages
        for _ in range(MOST_STEPS):
            self.notebook.run(number)
            if not self.is_led_on(number, steps):
                break
        if not is_wrong and self.has_failed(number):
            self.type_what_is_said(number)

    def is_led_on(self, number, steps=0):
        """Whether a cell names another one to run first; that is done."""
        links = self.notebook.cell(number).get_by_role("link", name="Go to that cell")
        is_led = links.count() > 0
        if self.has_raised(number) or is_led:
            said = self.notebook.cell(number).locator(".jp-OutputArea").inner_text()
            self.messages.append((number, said))
            assert "What it means:" in said, said
            assert "What to try:" in said, said
            assert links.count() == 1, said
            target = unquote(links.get_attribute("href")).partition("#cell-id=")[2]
            links.click()
            named = self.ids.index(target)
            expect(self.page.locator(f"{SHOWN} .jp-CodeCell").nth(named)).to_be_in_viewport()
            self.run(named, steps + 1)
        return is_led

    def has_raised(self, number):
        """Whether a cell has raised that is not meant to."""
        is_meant = "raises-exception" in self.cells[number]["metadata"].get("tags", ())
        kinds = [one["output_type"] for one in self.notebook.stored(number)]
        return "error" in kinds and not is_meant

    def has_failed(self, number):
        """Whether a remark names a way, or a command failed, which the solution's do not."""
        cells = (self.notebook.stored(number), self.solved[number]["outputs"])
        said, usual = (len(FAILED.findall(json.dumps(outputs))) for outputs in cells)
        return said > usual

    def type_what_is_said(self, number):
        """Type what a remark below a command says before what the cell has."""
        said = self.notebook.cell(number).locator(".jp-OutputArea").inner_text()
        self.messages.append((number, said))
        # Remarks are wrapped, and each line of one begins with a sign.
        remarks = re.sub(r"\s+(?:# )?", " ", said)
        commands = list(dict.fromkeys(SAID.findall(remarks)))
        assert commands, said
        head, _, rest = self.sources[number].partition("\n")
        self.notebook.write(number, "\n".join([head, *commands, rest]))
        self.notebook.run(number)
        assert not self.has_failed(number), self.notebook.cell(number).inner_text()

    def restart(self):
        """Restart the kernel: what went with it says so, wherever it is on the page."""
        self.notebook.restart()
        for number in self.open:
            words = next(one for call, one in GONE.items() if call in self.sources[number])
            expect(self.notebook.cell(number).get_by_text(words)).to_be_visible()

    # Exercises.

    def exercise(self, number, tries):
        """Try wrong answers, take a hint after each, then give the right one; both are checked."""
        exercise = self.about(number, "exercise")
        check = next(k for k in range(number, len(self.ids)) if self.about(k, "check") == exercise)
        right = "".join(self.solved[number]["source"])
        for text in tries:
            self.notebook.write(number, self.above(exercise, number) + text)
            self.run(number, is_wrong=True)
            self.run(check)
            self.notebook.says(check, f"Exercise {exercise}: not there yet")
            self.hint(check)
            self.go_back(number, check)
        self.notebook.write(number, right)
        self.card(check).get_by_role("button", name="Run again").click()
        shown = self.notebook.cell(check).locator(".jp-OutputArea")
        passed = shown.get_by_text(f"Exercise {exercise}: passed")
        link = shown.get_by_role("link", name="Go to that cell")
        with suppress(Late):
            passed.or_(link).first.wait_for(timeout=PATIENCE)
        if self.is_led_on(check):
            self.run(check)
        self.notebook.says(check, f"Exercise {exercise}: passed")
        expect(self.card(check).get_by_role("button")).to_have_count(0)
        self.is_saved(number, right)
        self.passed.append(exercise)

    def above(self, exercise, number):
        """The lines above an answer of the bank."""
        terminal = self.sources[number].partition("\n")[0].split()[-1]
        return ABOVE.get(exercise, "").format(terminal=terminal)

    def hint(self, check):
        """Take a hint by its button."""
        self.card(check).get_by_role("button", name="Hint").click()
        self.card(check).locator("[role=status] strong").first.wait_for()

    def go_back(self, number, check):
        """Do what a message says: go to another page, or type commands where the answer is."""
        shown = self.notebook.cell(check).locator(".jp-OutputArea")
        for words, paths in SAVED_ON.items():
            if words in shown.first.inner_text():
                for path in paths:
                    Desk(self.lab.root / FOLDER).write(f"src/{PACKAGE}/{path}", finished(path))
        commands = [one for one in shown.locator("code").all_inner_texts() if COMMAND.match(one)]
        if commands:
            head = self.sources[number].partition("\n")[0]
            self.notebook.write(number, "\n".join([head, *commands]))
            self.run(number)

    def card(self, check):
        """The buttons of a check."""
        return self.notebook.cell(check).locator(".rosbeat-check")

    def is_saved(self, number, text):
        """Wait until a cell's text is in the page's file."""
        deadline = time.monotonic() + PATIENCE / 1000
        while time.monotonic() < deadline:
            with suppress(ValueError):  # the file is being written
                if "".join(code_cells(self.lab.root / self.name)[number]["source"]) == text:
                    return
            time.sleep(0.05)
        raise AssertionError(f"cell {number} was not saved")

    # Predictions and questions.

    def predict(self, number):
        """Fill in the field of a prediction, first so that nobody can read it.

        However often its cell runs, and whenever its kernel has started, the outcome is the same.
        """
        whole = self.notebook.cell(number).locator(".rosbeat-predict")
        field = whole.get_by_label("Your prediction")
        form = field.get_attribute("placeholder")
        field.fill("???")
        whole.get_by_role("button", name="Compare", exact=True).click()
        whole.get_by_text("cannot be compared with what happened").wait_for()
        field.fill("no" if form == "yes or no" else "41")
        field.press("Enter")
        said = whole.get_by_text("You predicted")
        said.wait_for()
        expect(field).to_be_hidden()
        self.outcomes.setdefault(number, said.inner_text())
        if "workspace.terminal(" not in self.sources[number]:  # its programs end with the kernel
            assert said.inner_text() == self.outcomes[number], number

    def choose(self, number, right):
        """Choose all wrong answers of a quiz, or the right ones."""
        quiz = self.notebook.cell(number).locator(".rosbeat-quiz")
        for question in QUESTIONS[self.name[:2]]:
            group = quiz.get_by_role("group", name=f"Question {question.id}")
            for place, choice in enumerate(question.choices):
                if choice.right == right:
                    button = group.get_by_role("button").nth(place)
                    button.click()
                    expect(button).to_have_attribute("aria-pressed", "true")
                    expect(button).to_contain_text("✓" if right else "✗")
                    expect(group.get_by_role("status")).not_to_be_empty()

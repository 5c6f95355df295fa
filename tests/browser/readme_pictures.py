"""Make the pictures of the README and the documents: a page, the panel while it moves, a class.

    ./environment/course shell -c "python tests/browser/readme_pictures.py"

It writes `page.png`, `panel.gif` and `class.png` in `docs/images`, and needs a Chromium, as the
tests of this folder do (`ROSBEAT_BROWSER` may name one). Run it after the look of a page has
changed.
"""

import shutil
import sys
import tempfile
from base64 import b64decode
from collections import Counter
from io import BytesIO
from itertools import pairwise
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests"))

from PIL import Image  # noqa: E402
from playwright.sync_api import sync_playwright  # noqa: E402

from browser.lab import lab_server  # noqa: E402
from browser.notebook import PATIENCE, Notebook, browser_path, write_notebook  # noqa: E402
from sharing import class_folder, learner, record, served  # noqa: E402

IMAGES = ROOT / "docs" / "images"
WINDOW = {"width": 1120, "height": 960}
PAGE, LAST_CELL = "00_hear_the_heartbeat.ipynb", "viz.graph(newsroom)"
#: The most that the moving picture may weigh, in bytes, and its colours.
HEAVIEST, COLOURS = 1_500_000, 200
#: Seconds for which each of its pictures is seen at least.
SHORTEST = 0.06
PANEL = ".rosbeat-panel"
NODES = """
import random
from rclpy.node import Node
from std_msgs.msg import Float32, String
from rosbeat import Session

class Sensor(Node):
    def __init__(self):
        super().__init__("temperature_sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.celsius, self.random = 22.0, random.Random(4)
        self.create_timer(0.5, self.publish)

    def publish(self):
        self.celsius += self.random.uniform(-0.5, 0.5)
        self.publisher.publish(Float32(data=self.celsius))

class Monitor(Node):
    def __init__(self):
        super().__init__("temperature_monitor")
        self.create_subscription(Float32, "temperature", self.hear, 10)

    def hear(self, message):
        if message.data > 26:
            self.get_logger().warning(f"Too warm: {message.data:.1f}")
        else:
            self.get_logger().info(f"Fine: {message.data:.1f}")
"""
OPEN = "ros = Session()\nros.add(Monitor)\nros.add(Sensor)\nros.start()\nros.panel()"


#: How often each of 30 learners has made a mistake in an exercise of page 04, in turns.
MISTAKES = {
    "04a": ("callback-called", "callback-called", "name-error"),
    "04b": ("boundary", "alert-too-many", "boundary", "boundary"),
    "04c": ("wrong-window",),
    "04d": ("no-hysteresis", "no-hysteresis", "wrong-state"),
}


def main():
    """Make the pictures."""
    with tempfile.TemporaryDirectory() as name, sync_playwright() as tools:
        folder = Path(name)
        root = folder / "pages"
        root.mkdir()
        options = ["--no-sandbox", "--disable-dev-shm-usage"]
        browser = tools.chromium.launch(executable_path=browser_path(), args=options)
        with lab_server(folder, root) as lab:
            tab = browser.new_page(viewport=WINDOW)
            tab.set_default_timeout(PATIENCE)
            picture_of_a_page(tab, lab)
            picture_of_the_panel(tab, lab)
        picture_of_a_class(browser, folder / "class")
        browser.close()


def picture_of_a_class(browser, folder):
    """Make the picture of the page that `rosbeat class` shows."""
    folder.mkdir()
    for number in range(30):
        at = min(number // 6, 3)
        before = [record(one, "passed") for one in list(MISTAKES)[:at]]
        exercise, made = list(MISTAKES.items())[at]
        wrong = [record(exercise, mistake=made[number % len(made)])] * (1 + number % 4)
        learner(folder, number, *before, *wrong, *[record(exercise, "passed")] * (number % 3 == 0))
    tab = browser.new_page(viewport={"width": 1280, "height": 720})
    with served(class_folder(folder)) as server:
        tab.goto(server.url)
        tab.get_by_text("Updated at").wait_for()
        tab.evaluate("document.getElementById('clock').remove()")
        tab.screenshot(path=IMAGES / "class.png", full_page=True)
    tab.close()


def picture_of_a_page(tab, lab):
    """Write a picture of the first page, at the place where its nodes and their graph are."""
    shutil.copy(ROOT / "notebooks" / PAGE, lab.root)
    notebook = Notebook(tab, lab, PAGE)
    hide_the_side(tab)
    notebook.run_all()
    tab.set_viewport_size({**WINDOW, "height": 16_000})
    notebook.wait_until_drawn()
    tab.set_viewport_size(WINDOW)
    last = tab.locator(".jp-CodeCell", has_text=LAST_CELL).first
    # JupyterLab draws cells as they come into sight, which moves those below them.
    for _ in range(40):
        last.evaluate("one => one.scrollIntoView({ block: 'end' })")
        tab.wait_for_timeout(250)
        box = last.bounding_box()
        if box and box["height"] > 100 and box["y"] + box["height"] <= WINDOW["height"]:
            break
    else:
        raise SystemExit("The graph of the first page does not come into sight.")
    with Image.open(BytesIO(tab.screenshot())) as seen:
        few = seen.convert("RGB").quantize(COLOURS, dither=Image.Dither.NONE)
    few.save(IMAGES / "page.png", optimize=True)
    notebook.shut_down()


def picture_of_the_panel(tab, lab):
    """Write some seconds of the panel: the sensor talks, is paused, and somebody else is too warm.

    Raises:
        SystemExit: If the file is too large for a README.
    """
    write_notebook(lab.root / "panel.ipynb", NODES, OPEN)
    tab.set_viewport_size({**WINDOW, "height": 1500})
    notebook = Notebook(tab, lab, "panel.ipynb")
    hide_the_side(tab)
    notebook.run(0)
    notebook.run(1)
    panel = tab.locator(PANEL)
    panel.scroll_into_view_if_needed()
    panel.get_by_text("Fine").nth(4).wait_for()
    film = Film(tab, panel)
    film.take(2.5)
    panel.get_by_role("button", name="Pause /temperature_sensor").click()
    film.take(1)
    panel.get_by_label("Value", exact=True).fill("30")
    film.take(1.5)
    panel.get_by_role("button", name="Resume /temperature_sensor").click()
    film.take(2)
    film.save(IMAGES / "panel.gif")
    notebook.shut_down()
    if (IMAGES / "panel.gif").stat().st_size > HEAVIEST:
        raise SystemExit("docs/images/panel.gif is too large: take fewer seconds or colours.")


class Film:
    """Take what the browser draws for as long as it lasts, and save an element's part of it."""

    def __init__(self, tab, element):
        self._element, self._frames, self._height = element, [], 0.0
        self._tools = tab.context.new_cdp_session(tab)
        self._tools.on("Page.screencastFrame", self._see)
        self._tools.send("Page.startScreencast", {"format": "png"})

    def _see(self, frame):
        self._frames.append((frame["metadata"]["timestamp"], frame["data"]))
        self._tools.send("Page.screencastFrameAck", {"sessionId": frame["sessionId"]})

    def take(self, seconds):
        """Go on for so long."""
        self._element.page.wait_for_timeout(1000 * seconds)
        self._height = max(self._height, self._element.bounding_box()["height"])

    def save(self, path):
        """Write what was seen as GIF, each picture for as long as it was there."""
        self._tools.send("Page.stopScreencast")
        box = self._element.bounding_box()
        corner = (int(box["x"]), int(box["y"]))
        clip = (*corner, corner[0] + int(box["width"]), corner[1] + int(self._height))
        frames = []
        for at, data in self._frames:
            if not frames or at - frames[-1][0] >= SHORTEST:
                frames.append((at, Image.open(BytesIO(b64decode(data))).convert("RGB").crop(clip)))
        palette = common_colours([one for _, one in frames[::5]])
        few = [one.quantize(palette=palette, dither=Image.Dither.NONE) for _, one in frames]
        shown = [round(100 * (b - a)) * 10 for (a, _), (b, _) in pairwise(frames)]
        few[0].save(path, save_all=True, append_images=few[1:], duration=[*shown, 1500], loop=0)


def common_colours(images):
    """Make a palette of the colours that are seen most: one for all pictures, and none is mixed.

    What has not changed from one picture to the next is then not stored again.
    """
    counted = Counter()
    for image in images:
        for number, colour in image.getcolors(image.width * image.height):
            counted[colour] += number
    palette = Image.new("P", (1, 1))
    common = [value for colour, _ in counted.most_common(COLOURS) for value in colour]
    palette.putpalette(common + common[:3] * (256 - len(common) // 3))
    return palette


def hide_the_side(tab):
    """Close the file browser, which would take a quarter of the picture."""
    if tab.locator("#jp-left-stack").is_visible():
        tab.keyboard.press("Control+b")
        tab.locator("#jp-left-stack").wait_for(state="hidden")


if __name__ == "__main__":
    main()

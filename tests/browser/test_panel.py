"""The instrument panel in a real browser: look, click, move the sliders."""

import time
from ast import literal_eval

import pytest

from browser.accessibility import cut_off, issues
from browser.notebook import PATIENCE, Notebook, write_notebook

pytestmark = pytest.mark.ros

NODES = """
from rclpy.node import Node
from std_msgs.msg import Float32, String
from rosbeat import Session

class Sensor(Node):
    def __init__(self):
        super().__init__("sensor")
        self.publisher = self.create_publisher(Float32, "temperature", 10)
        self.create_timer(0.2, lambda: self.publisher.publish(Float32(data=22.0)))
        self.get_logger().info("Sensor started")

class Monitor(Node):
    def __init__(self):
        super().__init__("monitor")
        self.create_subscription(Float32, "temperature", self.hear, 10)
        self.publisher = self.create_publisher(String, "status", 10)

    def hear(self, message):
        status = "High" if message.data > 26 else "Low" if message.data < 20 else "Normal"
        self.publisher.publish(String(data=status))
        if status != "Normal":
            self.get_logger().warning(status)
"""
OPEN = """
ros = Session()
ros.add(Monitor)
sensor = ros.add(Sensor)
ros.start()
ros.panel()
"""
COUNT = """
import threading, comm
(sum(t.name == "rosbeat panel" for t in threading.enumerate()), len(ros.nodes),
 len(comm.get_comm_manager().comms))
"""
#: A chain of topics whose names need several lines each.
LONG = """
for k, name in enumerate(["the_window_state_of_the_north", "the_door_state_of_the_south", "sums"]):
    node = ros.add(Node(f"node_{k}"))
    node.create_publisher(Float32, name, 10)
    node.create_subscription(Float32, before if k else "status_of_all_the_rooms", print, 10)
    before = name
"""
#: Looks at pulses in the moment in which they are added, before the browser draws anything.
PULSES = """panel => {
    window.pulses = [];
    new MutationObserver(changes => {
        for (const change of changes) for (const dot of change.addedNodes) {
            if (!dot.classList?.contains('rb-pulse')) continue;
            const place = dot.transform.baseVal.consolidate()?.matrix;
            const point = new DOMPoint(place?.e ?? 0, place?.f ?? 0);
            const edges = [...dot.ownerSVGElement.querySelectorAll('.rb-edge')];
            const start = edges.map(edge => edge.getPointAtLength(0));
            const far = start.map(one => Math.hypot(one.x - point.x, one.y - point.y));
            window.pulses.push(Math.min(...far));
        }
    }).observe(panel, { childList: true, subtree: true });
}"""
PANEL = ".rosbeat-panel"
LOST = f"{PANEL} [role=alert]:not(:empty)"
STILL = ".rosbeat-still"


@pytest.fixture
def notebook(page, lab, request):
    """A notebook with a panel, all of it run."""
    name = f"{request.node.name.split('[')[0]}.ipynb"
    write_notebook(lab.root / name, NODES, OPEN, *getattr(request, "param", ()))
    made = Notebook(page, lab, name)
    made.run(0)
    made.run(1)
    page.locator(PANEL).scroll_into_view_if_needed()
    yield made
    made.shut_down()


def row(page, topic):
    return page.locator(f"{PANEL} .rb-topics tr", has=page.get_by_text(topic, exact=True))


def value(page, topic, text):
    """Wait until the newest value of a topic is a text."""
    row(page, topic).locator(".rb-value", has_text=text).wait_for(timeout=PATIENCE)


def leftovers(notebook):
    """Threads of panels, nodes and wires in the kernel."""
    notebook.run(2)
    return literal_eval(notebook.output(2))


def state(page, node, condition):
    item = page.locator(f'{PANEL} li[data-node="{node}"][data-condition="{condition}"]')
    item.wait_for(timeout=PATIENCE)


def slide(page, label, number):
    page.get_by_label(label, exact=True).fill(str(number))


def frames(page):
    return int(page.locator(PANEL).get_attribute("data-frames"))


def more_frames(page, count=10):
    """Wait until so many more frames have come."""
    wanted = frames(page) + count
    page.wait_for_function(
        f"() => +document.querySelector('{PANEL}').dataset.frames >= {wanted}", timeout=PATIENCE
    )


def test_a_slider_changes_what_the_monitor_says(notebook, page):
    value(page, "/status", "Normal")
    page.get_by_role("button", name="Pause /sensor").click()
    state(page, "/sensor", "paused")
    slide(page, "Value", 30)
    value(page, "/temperature", "30")
    value(page, "/status", "High")
    slide(page, "Value", 5)
    value(page, "/status", "Low")
    log = page.locator(f"{PANEL} .rb-log")
    log.get_by_text("[monitor]: Low").first.wait_for()
    assert "instrument_panel" in page.locator(f"{PANEL} .rb-graph svg").get_attribute("aria-label")


def test_a_pulse_is_on_its_arrow_from_the_beginning(notebook, page):
    page.eval_on_selector(PANEL, PULSES)
    page.wait_for_function("() => window.pulses.length >= 20", timeout=PATIENCE)
    assert max(page.evaluate("() => window.pulses")) < 1


@pytest.mark.parametrize("notebook", [(LONG,)], indirect=True)
def test_a_name_in_several_lines_looks_like_one_name(notebook, page, tmp_path):
    notebook.run(2)
    page.locator(f"{PANEL} [data-name='/sums']").wait_for()
    shown = page.eval_on_selector_all(
        f"{PANEL} svg g",
        """all => all.map(one => [one.dataset.name,
            [...one.querySelectorAll('.rb-name')].map(line => line.textContent)])""",
    )
    assert [name for name, _ in shown] == ["".join(rows) for _, rows in shown]
    assert max(len(rows) for _, rows in shown) > 1
    notebook.picture("panel-long", page.locator(f"{PANEL} .rb-graph"), tmp_path)


def test_a_slider_publishes_where_it_is_let_go(notebook, page):
    page.get_by_role("button", name="Pause /sensor").click()
    state(page, "/sensor", "paused")
    more_frames(page)
    count = row(page, "/temperature").locator("td").nth(2)
    before = int(count.inner_text())
    slider = page.get_by_label("Value", exact=True)
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    middle = box["y"] + box["height"] / 2
    page.mouse.move(box["x"] + box["width"] / 2, middle)
    page.mouse.down()
    for part in (0.6, 0.7, 0.8, 0.9):
        page.mouse.move(box["x"] + part * box["width"], middle)
        more_frames(page, 2)
    assert float(slider.input_value()) > 30
    assert int(count.inner_text()) == before
    page.mouse.up()
    value(page, "/status", "High")
    assert int(count.inner_text()) == before + 1


def test_nodes_stop_and_start(notebook, page):
    page.get_by_role("button", name="Stop /sensor").click()
    state(page, "/sensor", "stopped")
    assert page.locator(f"{PANEL} .rb-node").count() == 1
    page.get_by_role("button", name="Start /sensor").click()
    state(page, "/sensor", "running")
    more_frames(page)
    assert page.locator(f"{PANEL} .rb-node").count() == 2


def test_faults_and_load_arrive(notebook, page):
    page.get_by_label("Fault", exact=True).select_option("offset")
    slide(page, "Amount", 10)
    value(page, "/temperature", "32")
    value(page, "/status", "High")
    page.get_by_label("Fault", exact=True).select_option("nan")
    value(page, "/temperature", "nan")
    page.get_by_label("Fault", exact=True).select_option("none")
    value(page, "/temperature", "22")
    slide(page, "Load", 600)
    page.locator(f"{PANEL} .rb-graph", has_text="instrument_panel").wait_for()


def test_the_log_is_filtered_by_node_and_level(notebook, page):
    log = page.locator(f"{PANEL} .rb-log")
    log.get_by_text("Sensor started").wait_for()
    slide(page, "Value", 30)
    log.get_by_text("High").first.wait_for()
    page.get_by_label("Least level").select_option("WARN")
    assert "Sensor started" not in log.inner_text()
    page.get_by_label("Least level").select_option("INFO")
    page.get_by_label("Log of node").select_option("sensor")
    assert "High" not in log.inner_text()
    assert "Sensor started" in log.inner_text()


BUSY = "import time\nend = time.monotonic() + 60\nwhile time.monotonic() < end: pass"


@pytest.mark.parametrize("notebook", [(BUSY,)], indirect=True)
def test_a_busy_kernel_is_not_taken_for_one_that_is_gone(notebook, page):
    notebook.start(2)
    notebook.cell(2).locator(".jp-InputPrompt", has_text="*").wait_for()
    for _ in range(4):
        page.wait_for_timeout(1000)  # what is tested is this time
        more_frames(page, 1)
        page.locator(LOST).wait_for(state="hidden")
    page.get_by_role("button", name="Pause /sensor").click(trial=True)  # it can be clicked
    notebook.interrupt()


def test_a_kernel_that_was_restarted_is_noticed_and_nothing_can_be_clicked(notebook, page):
    more_frames(page)
    notebook.restart()
    page.locator(
        LOST, has_text="Run All Above Selected Cell in the menu, then run this cell again."
    ).wait_for()
    enabled = f"{PANEL} .rb-side :is(button, input, select):enabled"
    page.wait_for_function(f"() => !document.querySelector('{enabled}')")
    notebook.run(0)
    notebook.run(1)
    value(page, "/status", "Normal")
    assert page.locator(PANEL).count() == 1
    page.locator(LOST).wait_for(state="hidden")
    page.get_by_role("button", name="Pause /sensor").click(trial=True)  # it can be clicked


@pytest.mark.parametrize("is_trusted", [True, False])
def test_a_page_without_its_kernel_has_the_picture_and_says_how_to_go_on(
    notebook, page, lab, is_trusted
):
    more_frames(page)
    assert not page.locator(STILL).is_visible()
    notebook.save()
    notebook.shut_down()
    page.locator(LOST).wait_for()
    name = notebook.name if is_trusted else "of_somebody_else.ipynb"
    if not is_trusted:
        text = (lab.root / notebook.name).read_text(encoding="utf-8")
        (lab.root / name).write_text(text.replace("status", "state"), encoding="utf-8")
    again = Notebook(page, lab, name)
    still = page.locator(STILL)
    still.get_by_text("For the live one, run this cell again").wait_for()
    assert "/temperature" in still.locator("img").get_attribute("alt")
    page.get_by_text("Error displaying widget").wait_for(state="hidden")
    again.shut_down()


@pytest.mark.parametrize("notebook", [("ros.wait(60)",)], indirect=True)
def test_clicks_count_while_the_kernel_is_busy(notebook, page):
    notebook.start(2)
    notebook.cell(2).locator(".jp-InputPrompt", has_text="*").wait_for()
    before = frames(page)
    page.get_by_role("button", name="Pause /sensor").click()
    state(page, "/sensor", "paused")
    slide(page, "Value", 30)
    value(page, "/status", "High")
    assert frames(page) > before
    assert "[*]" in notebook.cell(2).inner_text()
    notebook.interrupt()


def test_the_keyboard_reaches_everything_and_deletes_no_cell(notebook, page):
    page.get_by_role("button", name="Pause /sensor").focus()
    page.keyboard.press("Enter")
    state(page, "/sensor", "paused")
    # The focus stays on the button that took the other's place.
    page.keyboard.press("Enter")
    state(page, "/sensor", "running")
    slider = page.get_by_label("Value", exact=True)
    slider.focus()
    for key in ("ArrowRight", "ArrowUp", "d", "d", "x", "a"):
        page.keyboard.press(key)
    assert slider.input_value() == "22.2"
    page.locator(f"{PANEL} .rb-graph", has_text="instrument_panel").wait_for()  # it has published
    assert page.locator(".jp-CodeCell").count() == 2
    unnamed = page.eval_on_selector_all(
        f"{PANEL} :is(button, input, select, canvas, svg:not([aria-hidden]))",
        """all => all.filter(one => !one.getAttribute('aria-label') && !one.innerText
                             && !one.closest('label')?.innerText).length""",
    )
    assert unnamed == 0


@pytest.mark.parametrize("notebook", [(COUNT,)], indirect=True)
def test_running_the_cell_again_leaves_nothing_behind(notebook, page):
    before = leftovers(notebook)
    for _ in range(5):
        notebook.run(1)
        more_frames(page, 2)
    assert leftovers(notebook) == before
    assert before[:2] == (1, 2)
    assert page.locator(PANEL).count() == 1


@pytest.mark.parametrize("notebook", [("ros.close()",)], indirect=True)
def test_a_closed_session_leaves_a_picture(notebook, page):
    notebook.run(2)
    picture = notebook.cell(1).locator(f"{STILL} img")
    picture.wait_for()
    assert "/temperature" in picture.get_attribute("alt")
    assert page.locator(PANEL).count() == 0


def test_a_page_that_is_loaded_again_has_the_panel_again(notebook, page):
    more_frames(page)
    notebook.save()
    page.reload()
    page.locator(PANEL).wait_for()
    value(page, "/status", "Normal")
    more_frames(page)


def test_a_tab_that_slept_is_whole_again(notebook, page):
    value(page, "/status", "Normal")
    count = int(row(page, "/temperature").locator("td").nth(2).inner_text())
    tools = page.context.new_cdp_session(page)
    tools.send("Page.setWebLifecycleState", {"state": "frozen"})
    time.sleep(6)  # what is tested is this time
    tools.send("Page.setWebLifecycleState", {"state": "active"})
    page.wait_for_function(
        f"""() => [...document.querySelectorAll('{PANEL} .rb-topics tbody tr')]
            .some(row => +row.children[3].innerText > {count + 20})""",
        timeout=PATIENCE,
    )
    more_frames(page)


@pytest.mark.parametrize("theme", ["light", "dark"])
def test_it_can_be_looked_at(page, lab, theme, tmp_path):
    """Saves what a person sees; `ROSBEAT_SCREENSHOTS` may name a folder for it."""
    name = f"look_{theme}.ipynb"
    write_notebook(lab.root / name, NODES, OPEN)
    notebook = Notebook(page, lab, name)
    notebook.theme(theme)
    notebook.run_all()
    value(page, "/status", "Normal")
    slide(page, "Value", 30)
    value(page, "/status", "Normal")
    panel = page.locator(PANEL)
    panel.scroll_into_view_if_needed()
    assert issues(panel) == []
    path = notebook.picture(f"panel-{theme}", panel, tmp_path)
    assert path.stat().st_size > 10_000
    notebook.shut_down()


@pytest.mark.parametrize("width", [1000, 667], ids=["1000", "1000 at 150 %"])
def test_nothing_is_cut_off_in_a_narrow_window(notebook, page, width):
    page.set_viewport_size({"width": width, "height": 900})
    for fault in ("dropout", "nan", "offset"):
        page.get_by_label("Fault", exact=True).select_option(fault)
        more_frames(page)
        assert cut_off(page.locator(PANEL)) == []
    signs = "[\\u{2300}-\\u{23ff}\\u{25a0}-\\u{27bf}\\u{1f000}-\\u{1ffff}]"
    assert not page.locator(PANEL).evaluate(f"one => /{signs}/u.test(one.innerText)")

"""A class to review, and its review served in this process."""

from dataclasses import replace

from graded_classes import mark, observation
from rosbeat.grading.manual_marks import apply_manual, read_manual, write_template
from rosbeat.grading.marks import Gradebook, Graded, Solution
from rosbeat.grading.results import write_results
from rosbeat.grading.review import Review, ReviewServer
from rosbeat.page_runs.traces import trace_of
from serving import serving

#: Answers that differ in layout, in names, and in what they do.
SOLUTION = """\
class Monitor(Node):
    \"\"\"Says what a fridge is like.\"\"\"

    def __init__(self):
        super().__init__("monitor")
        self.limit = 8.0

    def listen(self, message):
        state = "Warm" if message.data > self.limit else "Fine"
        self.get_logger().info(state)
"""
LAYOUT = SOLUTION.replace('    """Says what a fridge is like."""\n\n', "").replace("8.0", "8.00")
NAMES = SOLUTION.replace("state", "word").replace("limit", "most").replace("message", "msg")
OTHER = SOLUTION.replace(">", ">=")


def a_class_to_review(learners=4):
    """Learners with one exercise right and one wrong, in turns by `LAYOUT`, `NAMES`, `OTHER`."""
    trace = trace_of(observation())
    made = []
    for number in range(learners):
        source = (LAYOUT, NAMES, OTHER)[number % 3]
        status = "failed" if source == OTHER else "passed"
        points = {"points": 2.0 * (status == "passed"), "judged": 2.0 * (status == "passed")}
        answer = mark("04a", status, source=source, trace=trace, out_of=2.0, mistake="boundary",
                      evidence="For a reading of 8 the node said Warm.", **points)  # fmt: skip
        held = mark("04b", "held", source=f"x = {number % 2}", answer="x", file="a.ipynb")
        marks = (replace(answer, mistake="") if status == "passed" else answer, held)
        made.append(Graded(f"{number:04}", f"Learner {number}", "folder", marks))
    solutions = (Solution("04a", SOLUTION, trace),)
    return Gradebook("1", tuple(made), (), solutions)


def served(out, judged):
    """Serve the review of a class whose results have been written."""

    def write(book):
        write_results(out, book)

    write(apply_manual(judged, read_manual(out / "manual.csv")))
    write_template(out / "manual.csv", judged)
    return serving(ReviewServer(Review(out, judged, write)))

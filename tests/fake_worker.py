"""Takes the place of a prepared process of grading, and does what the answer that it gets says.

It answers each page of each submission, and the rehearsal with what a file beside the notes says.
What it has been given is noted in the file that ROSBEAT_FAKE_WORKER names.
"""

import json
import os
import sys
import time

from rosbeat.grading.jobs import Evidence, PageEvidence, PageJob, read_line, to_line

NOTES = "ROSBEAT_FAKE_WORKER"
_REFUSED = '{"refused": ["No sandbox.", "Nothing was run.", "Try this."]}'


def note(word):
    with open(os.environ[NOTES], "a", encoding="utf-8") as file:
        file.write(f"{os.getpid()} {word}\n")


def answer(job):
    if job.subjects == {"03a": "Rehearsal"}:
        with open(f"{os.environ[NOTES]}.rehearsal", encoding="utf-8") as file:
            return file.read()
    text = job.cells[0].source
    word = text.split()[0]
    note(word)
    if word == "die":
        os._exit(3)
    if word == "die-once" and not os.path.exists(text.split()[1]):
        open(text.split()[1], "x").close()
        os._exit(3)
    if word == "silent":
        time.sleep(600)
    if word == "refuse":
        return _REFUSED
    if word == "half":
        print('{"how": "en', end="", flush=True)
        os._exit(0)
    if word in ("nonsense", "forged"):
        return {"nonsense": "Hello?", "forged": '{"seen": "ended"}'}[word]
    return to_line(PageEvidence({"03a": Evidence("ended", seen=text)}))


def main():
    note("start " + " ".join(sys.argv[1:]))
    if os.environ.get("ROSBEAT_NEVER_READY"):
        print("Traceback: no rclpy", file=sys.stderr)
        sys.exit(1)
    for line in sys.stdin:
        for one in json.loads(line):
            print(answer(read_line(PageJob, one)), flush=True)


if __name__ == "__main__":
    main()

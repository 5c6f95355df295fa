"""Grade a class's submissions: read them, run them in sandboxes, judge them outside, report.

`docs/architecture.md` follows one answer through the whole pipeline. `commands` contains the entry
points of `rosbeat release`, `collect` and `grade`.

- Input: `submissions` and `archives` (folders, zips), `notebook` (pages, submitted and the
  course's), `roster`, `deadlines`, `files` (CSV, safe names, whole writes).
- Running: `answers` and `jobs` (which code is run), `run` (a whole run), `pool` (of workers),
  `worker`, `sandbox`, `system_calls`, `observing`, `cluster`.
- Judging: `judging`, `ledger` (judged answers, so that a run can resume).
- Marks: `marks` (with what exercises are worth), `manual_marks` (points given by hand), `results`,
  `csv_exports` (Moodle, Canvas), `groups`.
- Reports: `report`, `feedback`, `traces`, `rendering` with `templates/`, and `review` (the page on
  which an instructor marks by eye).
- For the class: `release` creates the folder that learners get. `class_folder` reads what learners
  share while they work (`exercises.share` writes it), and `class_board` counts it and serves it to
  the instructor. `examples.json` is made by `tests/bank/examples.py`.
"""

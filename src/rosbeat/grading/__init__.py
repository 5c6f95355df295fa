"""Grade a class's submissions: read them, run them in sandboxes, judge them outside, report.

`docs/architecture.md` follows one answer through the whole pipeline. `commands` contains the entry
point of each command, and `options` parses its arguments.

- Input: `submissions` and `uploads` (folders, zips), `notebook` (the content of a page), `roster`,
  `deadlines`, `csv_table`, `course_pages`.
- Running: `answers` and `jobs` (which code is run), `run` (a whole run), `worker`, `sandbox`,
  `linux` (system calls), `observing`, `cluster`, `progress_bar`.
- Judging: `judging`, `ledger` (judged answers, so that a run can resume), `remarks`.
- Marks: `marks`, `weights`, `manual` (points given by hand), `results`, `tables` (CSV), `groups`.
- Reports: `report`, `feedback`, `traces`, `rendering` with `templates/`, `writing`, and `review`
  (the page on which an instructor marks by eye).
- For the class: `release` creates the folder that learners get. `class_folder` reads what learners
  share while they work (`exercises.share` writes it), `class_board` counts it, and `class_page`
  serves it to the instructor. `examples.json` is made by `tests/bank/examples.py`.
"""

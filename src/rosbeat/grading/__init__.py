"""Grade what a class hands in: read it, run it in sandboxes, judge it outside, report.

`docs/architecture.md` follows one answer through all of it. `commands` is where each command
begins, and `options` reads its arguments.

- What is handed in: `submissions` and `uploads` (folders, zips), `notebook` (what a page holds),
  `roster`, `deadlines`, `csv_table`, `course_pages`.
- Running: `answers` and `jobs` (which code is run), `run` (the whole of a run), `worker`,
  `sandbox`, `linux` (system calls), `observing`, `cluster`, `progress_bar`.
- Judging: `judging`, `ledger` (judged answers, so that a run can resume), `remarks`.
- Marks: `marks`, `weights`, `manual` (points given by hand), `results`, `tables` (CSV),
  `groups`.
- Reports: `report`, `feedback`, `traces`, `rendering` with `templates/`, `writing`, and `review`
  (the page on which an instructor marks by eye).
- For the class: `release` makes the folder that learners get.
"""

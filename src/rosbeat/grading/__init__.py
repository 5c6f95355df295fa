"""Grade submissions: read them, have them run and judged, report.

`docs/architecture.md` follows one answer through the whole pipeline. `commands` contains the entry
points of `rosbeat release`, `collect` and `grade`.

- Input: `submissions` and `archives` (folders, zips), `downloads` (whose a file is), `roster`,
  `teams`, `deadlines`, `files` (CSV, safe names, whole writes).
- `platforms`: a module for each learning platform, with its downloads, rosters and uploads.
- Judging: `run` (a whole run: pages go to `rosbeat.page_runs`), `cluster`, `ledger` (judged
  answers, so that a run can resume).
- Marks: `marks` (with what exercises are worth), `manual_marks` (points given by hand), `results`,
  `csv_exports` (the table of all marks), `groups`, `lock` (one run at a time in a folder).
- One submission: `one_submission` (for people and programs) and `platforms.autograders`.
- Reports: `report`, `feedback`, `traces`, `rendering` with `templates/`, and `review` (the page on
  which an instructor marks by eye).
- For the class: `release` creates the folder that learners get. `class_folder` reads what learners
  share while they work (`exercises.share` writes it), and `class_board` counts it and serves it to
  the instructor. `examples.json` is made by `tests/bank/examples.py`.
"""

"""Names of learners' folders and files that are meant for a terminal, a table, a disk."""

from hostile.deed import RIGHT, Upload
from hostile.pages import PAGE, page

_FILES = {PAGE: page(RIGHT)}

UPLOADS = tuple(
    Upload(name, files, "passed", folder=folder)
    for name, folder, files in (
        ("a formula", '=HYPERLINK("http://x","y")'.replace("/", "_"), _FILES),
        ("a formula with a blank", " \t=1+1", _FILES),
        ("markup", "<script>alert(1)<", _FILES),
        ("an escape of terminals", "\x1b[31mred\x1b]0;x\x07", _FILES),
        ("a line break", "two\nlines\r\n", _FILES),
        ("the other direction", "abc\u202egnp.exe", _FILES),
        ("nothing to be seen", "\u200b\u2060", _FILES),
        ("an option", "--out=x", _FILES),
        ("a name of a result", "results.json", _FILES),
        ("a device", "CON", _FILES),
        ("two dots and more", "..%2f..%2fetc", _FILES),
        ("a very long name", "W" * 250, _FILES),
        ("bytes that are no text", "half\udcff", _FILES),
        ("another script", "אבג 数学 🦊", _FILES),
        ("a name of a file", "file", {f"x\x1b[2J\u202e{PAGE}": page(RIGHT)}),
    )
)

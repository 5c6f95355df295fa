"""A class of honest learners and all the others, written into a folder."""

import os

from hostile import (
    channels,
    floods,
    forging,
    interpreter,
    names,
    objects,
    pages,
    patches,
    peeking,
    processes,
    texts,
)
from hostile.deed import CANARY, CLASS, COURSE, FRIDGE, HOME, RIGHT, WRONG, Upload

#: Every attack from within an answer, by its name.
DEEDS = {
    deed.name: deed
    for module in (
        *(processes, floods, channels, patches, forging, peeking),
        *(interpreter, objects, texts),
    )
    for deed in module.DEEDS
}
UPLOADS = {upload.name: upload for module in (pages, names) for upload in module.UPLOADS}
HONEST = {
    "honest-ana": f"# {CANARY}\n{RIGHT}",
    "honest-ben": WRONG,
    "honest-cyd": RIGHT.replace("Float32(data=45.0)", "45.0"),
}
PAGE_04 = "04_write_a_subscriber.ipynb"


def placed(text, places):
    """A text in which the places of canaries stand."""
    for mark, place in zip((HOME, CLASS, COURSE), places, strict=True):
        text = text.replace(mark, str(place))
    return text


def hand_in(folder, places):
    """Write the class; give the folder's name of each deed and upload.

    Args:
        folder: Where to.
        places: The home, the folder of the class and the course, for attacks that look there.
    """
    for name, answer in HONEST.items():
        _write(folder / name, {pages.PAGE: pages.page(answer)})
    found = {}
    for number, deed in enumerate(DEEDS.values()):
        found[deed.name] = f"deed-{number:03}"
        _write(folder / found[deed.name], _files_of(deed, places))
    for number, upload in enumerate(UPLOADS.values()):
        found[upload.name] = upload.folder or f"upload-{number:03}"
        _write(folder / found[upload.name], upload.files)
    return found


def large(folder):
    """A learner whose notebook has 200 MB, and one who hands in a link."""
    _write(folder / "large", {})
    with (folder / "large" / pages.PAGE).open("wb") as file:
        file.truncate(200_000_000)
    _write(folder / "linked", {})
    (folder / "linked" / pages.PAGE).symlink_to(folder / "honest-ana" / pages.PAGE)


def _files_of(deed, places):
    answer = placed(deed.answer, places)
    if deed.exercise == "03a":
        return {pages.PAGE: pages.page(answer)}
    body = (pages.ROOT / "notebooks" / PAGE_04).read_text(encoding="utf-8")
    loaded = pages.json.loads(body)
    pages.cell_of(loaded, "exercise", deed.exercise)["source"] = answer
    return {PAGE_04: pages.json.dumps(loaded).encode()}


def _write(folder, files):
    os.makedirs(folder, exist_ok=True)
    for name, content in files.items():
        (folder / name).write_bytes(content() if callable(content) else content)


__all__ = ["DEEDS", "FRIDGE", "HONEST", "UPLOADS", "Upload", "hand_in", "large", "placed"]

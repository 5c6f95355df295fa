"""A look at finished pictures: what is written and drawn, and that nothing overlaps."""

from itertools import combinations


def texts(picture):
    """Return every text that is shown, whichever axes it belongs to."""
    figure = picture.figure
    found = [text for axes in figure.axes for text in axes.texts]
    for axes in figure.axes:
        if axes.axison:
            found += [*_ticks(axes.xaxis, axes.get_xlim()), *_ticks(axes.yaxis, axes.get_ylim())]
            found.append(axes.xaxis.label)
    return [text for text in found if text.get_text().strip() and text.get_visible()]


def _ticks(axis, limits):
    """Return the labels of those ticks that are in view; the others exist, but are not drawn."""
    low, high = sorted(limits)
    labels = zip(axis.get_ticklocs(), axis.get_ticklabels(), strict=True)
    return [label for place, label in labels if low <= place <= high]


def words_in(picture):
    return [text.get_text() for text in texts(picture)]


def is_tidy(picture):
    """Assert that all text is inside the picture and that no two texts overlap."""
    figure = picture.figure
    figure.canvas.draw()
    boxes = [(text.get_text(), text.get_window_extent()) for text in texts(picture)]
    edge = figure.bbox
    for words, box in boxes:
        inside = box.x0 >= 0 and box.y0 >= 0 and box.x1 <= edge.x1 and box.y1 <= edge.y1
        assert inside, f"{words!r} is cut off"
    for (one, a), (other, b) in combinations(boxes, 2):
        across = min(a.x1, b.x1) - max(a.x0, b.x0)
        along = min(a.y1, b.y1) - max(a.y0, b.y0)
        # Text extents include the room for letters like g; one pixel of it may be shared.
        assert across <= 1 or along <= 2, f"{one!r} overlaps {other!r}"
    return True


def patches(picture, kind):
    return [patch for patch in picture.figure.axes[0].patches if type(patch) is kind]


def heads(picture):
    """Return the heads of the arrows."""
    return [patch for patch in picture.figure.axes[0].patches if patch.get_zorder() == 2.5]


def lines(picture, marker, layer=None):
    """Return the lines with a marker, of a layer (zorder) or of all."""
    found = [line for line in picture.figure.axes[0].lines if line.get_marker() == marker]
    return [line for line in found if layer is None or line.get_zorder() == layer]

"""What a screen reader, a keyboard and weak eyes need: axe-core's rules, and two of our own."""

from functools import cache
from pathlib import Path

import axe_playwright_python

#: What axe-core finds in an element, of what it calls serious or critical.
AUDIT = """async root => {
    // It would fetch style sheets on its own otherwise.
    const options = { preload: false, resultTypes: ['violations'] };
    const { violations } = await axe.run(root, options);
    return violations.filter(one => ['serious', 'critical'].includes(one.impact)).flatMap(one =>
        one.nodes.map(node => `${one.id}: ${node.html.slice(0, 120)} ${node.failureSummary}`));
}"""
#: The controls that do not show that they have the focus.
UNSEEN_FOCUS = """root => [...root.querySelectorAll('a, button, input, select, [tabindex]')]
    .filter(one => one.checkVisibility() && !one.disabled)
    .filter(one => {
        one.focus({ focusVisible: true });
        const { outlineStyle, outlineWidth } = getComputedStyle(one);
        return outlineStyle === 'none' || parseFloat(outlineWidth) < 1;
    }).map(one => one.outerHTML.slice(0, 120))"""
#: The elements whose text is cut off, or that reach out of the root.
CUT_OFF = """root => {
    const edge = root.getBoundingClientRect().right + 1;
    const pen = document.createElement('canvas').getContext('2d');
    const cut = (one) => {
        const { overflowX, font } = getComputedStyle(one);
        if (one.tagName === 'SELECT') {
            pen.font = font;
            const chosen = one.selectedOptions[0]?.text || '';
            return pen.measureText(chosen).width > one.clientWidth - 16;  // the arrow
        }
        return one.getBoundingClientRect().right > edge
            || overflowX === 'hidden' && one.scrollWidth > one.clientWidth + 1;
    };
    return [...root.querySelectorAll('*')]
        .filter(one => one.checkVisibility() && !one.closest('svg') && cut(one))
        .map(one => one.outerHTML.slice(0, 120));
}"""


@cache
def rules():
    """The script of axe-core, as its package brings it."""
    folder = Path(axe_playwright_python.__file__).parent
    return (folder / "axe.min.js").read_text(encoding="utf-8")


def serious(element):
    """What axe-core calls serious in an element, in words.

    Args:
        element: Playwright's locator of it.
    """
    if not element.page.evaluate("() => 'axe' in window"):
        element.page.evaluate(rules())
    return element.evaluate(AUDIT)


def issues(element):
    """What breaks a rule in an element, in words, and which of its controls hide their focus."""
    return serious(element) + element.evaluate(UNSEEN_FOCUS)


def cut_off(element):
    """The parts of an element of which something cannot be seen."""
    return element.evaluate(CUT_OFF)

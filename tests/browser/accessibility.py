"""What a screen reader, a keyboard and weak eyes need: axe-core's rules, and three of our own."""

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
#: The words whose contrast with what is behind them is below 4.5, and their contrast. axe-core does
#: not judge text that has a filter.
FAINT = """root => {
    const canvas = document.createElement('canvas');
    const pen = canvas.getContext('2d', { willReadFrequently: true });
    const pixel = (color) => {
        pen.clearRect(0, 0, 1, 1);
        pen.fillStyle = color;
        pen.fillRect(0, 0, 1, 1);
        const [red, green, blue, alpha] = pen.getImageData(0, 0, 1, 1).data;
        return [[red, green, blue], alpha / 255];
    };
    const over = ([ink, alpha], ground) =>
        ink.map((part, k) => part * alpha + ground[k] * (1 - alpha));
    const behind = (one) => {
        if (!one) return [255, 255, 255];
        const paint = pixel(getComputedStyle(one).backgroundColor);
        return paint[1] === 1 ? paint[0] : over(paint, behind(one.parentElement));
    };
    const brightness = (one) => one ? brightness(one.parentElement)
        * (/brightness\\(([\\d.]+)\\)/.exec(getComputedStyle(one).filter)?.[1] || 1) : 1;
    const luminance = (color) => color.map(part => Math.min(part, 255) / 255)
        .map(part => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4)
        .reduce((sum, part, k) => sum + part * [0.2126, 0.7152, 0.0722][k], 0);
    const texts = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const faint = new Set();
    while (texts.nextNode()) {
        const text = texts.currentNode.data.trim(), one = texts.currentNode.parentElement;
        if (!text || !one.checkVisibility() || one.closest('svg, script, style')) continue;
        const ground = behind(one);
        const ink = over(pixel(getComputedStyle(one).color), ground);
        const seen = ink.map(part => part * brightness(one));
        const [dark, light] = [ground, seen].map(luminance).sort((one, other) => one - other);
        const contrast = (light + 0.05) / (dark + 0.05);
        if (contrast < 4.5) faint.add(`${contrast.toFixed(2)}: ${text.slice(0, 40)}`);
    }
    return [...faint];
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


def faint(element):
    """The words in an element that are not easy to read, each with its contrast."""
    return element.evaluate(FAINT)

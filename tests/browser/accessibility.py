"""What a screen reader, a keyboard and weak eyes need of an output: rules after WCAG 2, by hand.

The rules are those of axe-core that outputs, cards and the panel could break seriously.
"""

#: The rules, applied to one element and all that is in it; returns what breaks them, in words.
AUDIT = """root => {
    const found = [];
    const all = (what) => [...root.querySelectorAll(what)].filter(one => one.checkVisibility());
    const show = (one) => one.outerHTML.slice(0, 120);
    const complain = (rule, one) => found.push(`${rule}: ${show(one)}`);

    const parse = (colour) => {
        const canvas = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
        canvas.fillStyle = colour;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
    };
    const over = ([r, g, b, a], under) => [r, g, b].map((c, k) => a * c + (1 - a) * under[k]);
    const ground = (one) => {
        if (!one) return [255, 255, 255];
        const colour = parse(getComputedStyle(one).backgroundColor);
        return colour[3] === 1 ? colour : over(colour, ground(one.parentElement));
    };
    const light = (colour) => {
        const [r, g, b] = colour.map(c => c / 255)
            .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const contrast = (one) => {
        const behind = ground(one);
        const [a, b] = [light(over(parse(getComputedStyle(one).color), behind)), light(behind)];
        return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    };
    const texts = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    while (texts.nextNode()) {
        const one = texts.currentNode.parentElement;
        if (!texts.currentNode.data.trim() || !one.checkVisibility()) continue;
        if (one.closest(':disabled, style, svg')) continue;
        const ratio = contrast(one);
        if (ratio < 4.5) complain(`contrast ${ratio.toFixed(2)} of ${texts.currentNode.data}`, one);
    }

    const name = (one) => one.getAttribute('aria-label') || one.innerText?.trim()
        || [...(one.labels || [])].map(label => label.innerText.trim()).join('');
    for (const one of all('a, button, input, select, canvas, svg:not([aria-hidden]), [role=img]')) {
        if (!name(one)) complain('without a name', one);
    }
    for (const one of all('img:not([alt])')) complain('without words', one);
    for (const one of all('table')) {
        if (!one.querySelector('th[scope]')) complain('a table without headers', one);
    }
    for (const one of all('th')) if (!one.innerText.trim()) complain('an empty header', one);
    for (const one of all('ul > :not(li)')) complain('no item of a list', one);
    for (const one of all('*')) {
        const { overflowX, overflowY } = getComputedStyle(one);
        const scrolls = (way, most, shown) => ['auto', 'scroll'].includes(way) && most > shown + 1;
        const is_moved = scrolls(overflowX, one.scrollWidth, one.clientWidth)
            || scrolls(overflowY, one.scrollHeight, one.clientHeight);
        if (is_moved && one.tabIndex < 0) complain('scrolls, and the keyboard cannot', one);
    }
    return found;
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


def issues(element):
    """What breaks a rule in an element, in words.

    Args:
        element: Playwright's locator of it.
    """
    return element.evaluate(AUDIT) + element.evaluate(UNSEEN_FOCUS)


def cut_off(element):
    """The parts of an element of which something cannot be seen."""
    return element.evaluate(CUT_OFF)

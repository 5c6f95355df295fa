// Says of what is wider than the window that it scrolls, and lets the keyboard scroll it.
const WIDE = ["figure.rosbeat-picture", 'p:has(> img[src$=".svg"])', "pre", ".pst-scrollable-table-container"]

function mark(box) {
  const hidden = box.scrollWidth - box.clientWidth
  box.classList.toggle("scrolls", hidden > 1)
  box.classList.toggle("goes-on", hidden - box.scrollLeft > 1)
  if (hidden > 1) box.tabIndex = 0
  else box.removeAttribute("tabindex")
}

document.addEventListener("DOMContentLoaded", () => {
  // It is called at once, when the window changes, and when a box of answers opens.
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => mark(entry.target)))
  for (const box of document.querySelectorAll(`.bd-article :is(${WIDE})`)) {
    watch.observe(box)
    box.addEventListener("scroll", () => mark(box), { passive: true })
  }
})

// Says of what is wider than the window that it scrolls, and lets the keyboard scroll it.
const WIDE = [
  "figure.rosbeat-picture",
  'p:has(> img[src$=".svg"])',
  "pre",
  ".pst-scrollable-table-container",
]


// What scrolls gets more room (`site.css`), so it is measured without.
function measure(box) {
  const place = box.scrollLeft
  box.classList.remove("scrolls")
  const isWide = box.scrollWidth > box.clientWidth + 1
  box.classList.toggle("scrolls", isWide)
  box.scrollLeft = place
  if (isWide) box.tabIndex = 0
  else box.removeAttribute("tabindex")
  fade(box)
}

function fade(box) {
  box.classList.toggle("goes-on", box.scrollWidth - box.clientWidth - box.scrollLeft > 1)
}

document.addEventListener("DOMContentLoaded", () => {
  // It is called at once, when the window changes, and when a box of answers opens.
  const watch = new ResizeObserver((entries) => entries.forEach((entry) => measure(entry.target)))
  for (const box of document.querySelectorAll(`.bd-article :is(${WIDE})`)) {
    watch.observe(box)
    box.addEventListener("scroll", () => fade(box), { passive: true })
  }
})

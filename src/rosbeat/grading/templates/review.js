// Keys: n and p (or the arrows) lead to the next and the previous group, e to the points.
// Ctrl-Enter saves and goes on; Escape leaves a field.
document.addEventListener("keydown", (event) => {
  const form = document.getElementById("give");
  if (event.key === "Enter" && (event.ctrlKey || event.metaKey) && form) {
    event.preventDefault();
    form.querySelector("button[name=next]").click();
    return;
  }
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  if (event.target.closest("input[type=text], textarea")) {
    if (event.key === "Escape") event.target.blur();
    return;
  }
  const link = { n: "next", ArrowRight: "next", p: "previous", ArrowLeft: "previous" }[event.key];
  if (link) document.getElementById(link)?.click();
  if (event.key === "e" && form) {
    event.preventDefault();
    form.elements.points.focus();
  }
});
const all = document.getElementById("all");
all?.addEventListener("change", () => {
  document.querySelectorAll("input[name=member]").forEach((one) => {
    one.checked = all.checked;
  });
});

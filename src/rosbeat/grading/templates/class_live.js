// Ask for the board every two seconds, and replace the sections that have changed.
const root = document.documentElement;
const board = document.getElementById("board");
const clock = document.getElementById("clock");
const news = document.getElementById("news");
const pressed = (button) => button.getAttribute("aria-pressed") === "true";
const sections = new Map([...board.children].map((one) => [one.id, one.outerHTML]));
let chosen; // the mistake that a person has opened, or an empty text for none

const toggles = (button, act) => {
  button.addEventListener("click", () => {
    button.setAttribute("aria-pressed", String(!pressed(button)));
    act?.(pressed(button));
  });
};
const pause = document.getElementById("pause");
toggles(pause, (on) => (on ? (clock.textContent = `Paused at ${now()}`) : look()));
toggles(document.getElementById("names"), (on) => (root.dataset.names = on ? "on" : "off"));
document.getElementById("theme").addEventListener("click", () => {
  const dark = root.dataset.theme
    ? root.dataset.theme === "dark"
    : matchMedia("(prefers-color-scheme: dark)").matches;
  root.dataset.theme = dark ? "light" : "dark";
});

board.addEventListener("click", (event) => {
  const mistake = event.target.closest("summary")?.parentElement;
  if (mistake) chosen = mistake.open ? "" : mistake.id; // it opens or closes after this
});
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey) return;
  const summary = board.querySelectorAll(".mistake > summary")[["1", "2", "3"].indexOf(event.key)];
  if (summary) {
    event.preventDefault();
    summary.click();
    summary.focus();
  }
});

const now = () => new Date().toLocaleTimeString();

function replace(old, next) {
  const focused = old.contains(document.activeElement) ? document.activeElement.id : "";
  const open = old.querySelector(".mistake[open]");
  if (next.id === "mistakes" && chosen !== undefined) {
    next.querySelectorAll(".mistake").forEach((one) => (one.open = one.id === chosen));
    // What is being discussed stays, also when other mistakes are more common by now.
    if (open && open.id === chosen && !next.querySelector(`#${CSS.escape(chosen)}`)) {
      next.querySelector("h2").after(open);
    }
  }
  old.replaceWith(next);
  if (focused) document.getElementById(focused)?.focus({ preventScroll: true });
}

function show(html) {
  const made = document.createElement("template");
  made.innerHTML = html;
  const first = () => board.querySelector(".mistake > summary")?.textContent.trim() ?? "";
  const before = first();
  for (const next of [...made.content.children]) {
    const same = sections.get(next.id) === next.outerHTML;
    sections.set(next.id, next.outerHTML);
    if (!same) replace(document.getElementById(next.id), next);
  }
  if (first() !== before) news.textContent = `Most common now: ${first()}`;
}

async function look() {
  try {
    const answer = await fetch("board", { cache: "no-store" });
    if (!answer.ok) throw new Error(answer.statusText);
    const html = await answer.text();
    if (pressed(pause)) return;
    show(html);
    clock.textContent = `Updated at ${now()}`;
    root.dataset.lost = "";
  } catch {
    if (!root.dataset.lost) clock.textContent = `No answer from rosbeat class since ${now()}`;
    root.dataset.lost = "yes";
  }
}

async function run() {
  for (;;) {
    if (!pressed(pause) && !document.hidden) await look();
    await new Promise((resolve) => setTimeout(resolve, 2000));
  }
}
run();

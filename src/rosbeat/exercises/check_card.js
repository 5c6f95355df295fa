// The buttons below the card of a check: clicks out, words in.
//
// The kernel counts in `done` what it has carried out. Until it has, the buttons are not disabled,
// which would take the focus away from them; they say so and do nothing.

const PATIENCE = 5000; // milliseconds after which the page says that the kernel has not answered

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, value);
  }
  // JupyterLab's one-letter commands do not apply on a button; it looks for this on the element.
  if (tag === "button") element.setAttribute("data-lm-suppress-shortcuts", "true");
  element.append(...children);
  return element;
}

/** Whether the code cell above this one was changed after it ran; JupyterLab marks such a cell. */
function isAboveChanged(el) {
  let cell = el.closest(".jp-Cell")?.previousElementSibling;
  while (cell && !cell.classList.contains("jp-CodeCell")) cell = cell.previousElementSibling;
  return cell?.classList.contains("jp-mod-dirty") ?? false;
}

const CHANGED =
  "The cell above was changed after it ran. This is the verdict on what ran: " +
  "run the cell above, and then Run again.";

function render({ model, el }) {
  const exercise = model.get("exercise");
  let timer = 0;
  let waitsFor = 0;

  const button = (text, does, more = {}) =>
    make("button", { type: "button", onclick: does, ...more }, text);
  const ask = (what, words) => () => {
    if (waitsFor > model.get("done")) return;
    waitsFor = model.get("done") + 1;
    status.textContent = words;
    update();
    clearTimeout(timer);
    timer = setTimeout(() => {
      status.textContent =
        "The kernel has not answered yet. It answers when the cell that runs has ended; " +
        "if the kernel was restarted, run the cell of this check again.";
      waitsFor = 0;
      update();
    }, PATIENCE);
    model.send({ do: what });
  };
  const sure = (open) => {
    row.hidden = open;
    question.hidden = !open;
    (open ? question : row).querySelector(open ? "button" : "[data-do=answer]").focus();
  };

  const row = make(
    "div",
    { class: "rb-buttons" },
    button("Hint", ask("hint", "Looking for a hint ..."), { "data-do": "hint" }),
    button("Show the answer", () => sure(true), { "data-do": "answer" }),
    button("Run again", ask("again", "Checking ..."), { "data-do": "again" }),
  );
  const question = make(
    "div",
    { class: "rb-buttons", role: "group", "aria-label": "Show the answer?", hidden: true },
    make("span", {}, "Show the whole answer, and stop looking for it yourself?"),
    button("No, not yet", () => sure(false)),
    button("Yes, show it", () => {
      sure(false);
      ask("answer", "Looking for the answer ...")();
    }),
  );
  const note = make("p", { hidden: true }, CHANGED);
  const status = make("p", { role: "status" });
  const said = make("div", { "aria-live": "polite" });
  const whole = make(
    "div",
    { class: "rosbeat-check", role: "group", "aria-label": `Help with exercise ${exercise}` },
    note, row, question, status, said,
  );

  function update() {
    const passed = model.get("passed");
    if (passed) question.hidden = true;
    row.hidden = passed || !question.hidden;
    row.querySelector("[data-do=answer]").hidden = !model.get("has_answer");
    for (const one of row.querySelectorAll("button")) {
      one.setAttribute("aria-disabled", waitsFor > model.get("done") ? "true" : "false");
    }
    note.hidden = !isAboveChanged(el);
  }

  function hear() {
    clearTimeout(timer);
    const hadFocus = whole.contains(document.activeElement);
    update();
    said.innerHTML = model.get("said");
    status.textContent = model.get("said") ? "" : "Checked again: the result is above.";
    if (hadFocus && model.get("passed")) {
      status.tabIndex = -1;
      status.focus();
    }
  }

  model.on("change:done", hear);
  el.append(whole);
  said.innerHTML = model.get("said");
  update();
  requestAnimationFrame(update); // only now is the output in its cell
  return () => {
    clearTimeout(timer);
    model.off("change:done", hear);
  };
}

export default { render };

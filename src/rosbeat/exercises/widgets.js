// What an exercise offers in the browser: the buttons below the card of a check, and the field for a
// prediction. Clicks go out, words come in.
//
// The kernel counts in `done` what it has carried out. Until it has, the buttons are not disabled,
// which would take the focus away from them; they say so and do nothing.

const PATIENCE = 5000; // milliseconds after which the page says that the kernel has not answered
const SILENCE =
  "The kernel has not answered yet. It answers when the cell that runs has ended; " +
  "if the kernel was restarted, run this cell again.";

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false) element.setAttribute(name, value);
  }
  // JupyterLab's one-letter commands do not apply here; it looks for this on the element itself.
  if (tag === "button" || tag === "input") {
    element.setAttribute("data-lm-suppress-shortcuts", "true");
  }
  element.append(...children);
  return element;
}

const button = (text, does, more = {}) =>
  make("button", { type: "button", onclick: does, ...more }, text);

/** Talk to the kernel: one question at a time, and a word if no answer comes. */
function talk(model, whole, status, changed) {
  let timer = 0;
  let waitsFor = 0;

  function update() {
    const waits = waitsFor > model.get("done");
    for (const one of whole.querySelectorAll("button")) {
      one.setAttribute("aria-disabled", waits ? "true" : "false");
    }
    changed();
  }
  function ask(message, words) {
    if (waitsFor > model.get("done")) return;
    waitsFor = model.get("done") + 1;
    status.textContent = words;
    update();
    clearTimeout(timer);
    timer = setTimeout(() => {
      status.textContent = SILENCE;
      waitsFor = 0;
      update();
    }, PATIENCE);
    model.send(message);
  }
  function end() {
    clearTimeout(timer);
  }
  return { ask, update, end };
}

// A check.

const CHANGED =
  "The cell above was changed after it ran. This is the verdict on what ran: " +
  "run the cell above, then check again.";

/** Whether the code cell above this one was changed after it ran; JupyterLab marks such a cell. */
function isAboveChanged(el) {
  let cell = el.closest(".jp-Cell")?.previousElementSibling;
  while (cell && !cell.classList.contains("jp-CodeCell")) cell = cell.previousElementSibling;
  return cell?.classList.contains("jp-mod-dirty") ?? false;
}

function check(model, el) {
  const sure = (open) => {
    row.hidden = open;
    question.hidden = !open;
    (open ? question : row).querySelector(open ? "button" : "[data-do=answer]").focus();
  };
  const ask = (what, words) => () => wire.ask({ do: what }, words);
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
  const label = `Help with exercise ${model.get("exercise")}`;
  const whole = make(
    "div",
    { class: "rosbeat-exercise rosbeat-check", role: "group", "aria-label": label },
    note, row, question, status, said,
  );
  const wire = talk(model, whole, status, () => {
    if (model.get("passed")) question.hidden = true;
    row.hidden = model.get("passed") || !question.hidden;
    row.querySelector("[data-do=answer]").hidden = !model.get("has_answer");
    note.hidden = !isAboveChanged(el);
  });

  function hear() {
    const hadFocus = whole.contains(document.activeElement);
    wire.end();
    wire.update();
    said.innerHTML = model.get("said");
    status.textContent = model.get("said") ? "" : "Checked again: the result is above.";
    if (hadFocus && model.get("passed")) {
      status.tabIndex = -1;
      status.focus();
    }
  }
  said.innerHTML = model.get("said");
  return { whole, wire, hear };
}

// A prediction.

function predict(model) {
  const field = make("input", {
    type: "text",
    "aria-label": "Your prediction",
    placeholder: model.get("form"),
    autocomplete: "off",
    spellcheck: "false",
  });
  const answer = () =>
    field.value.trim()
      ? wire.ask({ do: "guess", guess: field.value }, "Comparing ...")
      : (status.textContent = "Write what you expect, or choose Show me.");
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && !event.isComposing) answer();
  });
  const row = make(
    "div",
    { class: "rb-buttons" },
    make("span", {}, "What do you expect?"),
    field,
    button("Compare", answer),
    button("Show me", () => wire.ask({ do: "show" }, "")),
  );
  const status = make("p", { role: "status" });
  const whole = make(
    "div",
    { class: "rosbeat-exercise rosbeat-predict", role: "group", "aria-label": "Predict" },
    row, status,
  );
  const wire = talk(model, whole, status, () => {
    row.hidden = model.get("passed");
  });

  function hear() {
    const hadFocus = whole.contains(document.activeElement);
    wire.end();
    wire.update();
    status.textContent = model.get("said");
    if (hadFocus && model.get("passed")) {
      status.tabIndex = -1;
      status.focus();
    }
  }
  return { whole, wire, hear };
}

function render({ model, el }) {
  const made = model.get("kind") === "predict" ? predict(model) : check(model, el);
  model.on("change:done", made.hear);
  el.append(made.whole);
  made.wire.update();
  const frame = requestAnimationFrame(made.wire.update); // only now is the output in its cell
  return () => {
    cancelAnimationFrame(frame);
    made.wire.end();
    model.off("change:done", made.hear);
  };
}

export default { render };

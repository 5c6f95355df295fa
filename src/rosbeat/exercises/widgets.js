// What an exercise offers in the browser: the buttons below the card of a check, the field for a
// prediction, and the choices of a quiz. Clicks go out, and HTML that the kernel has made comes in.
//
// The kernel counts in `begun` and `done` what it has begun and what it has carried out. Until then
// the buttons are not disabled, which would take the focus away from them; they do nothing.

const PATIENCE = 5000; // milliseconds after which the page says that the kernel has not answered
const SILENCE =
  "The kernel has not answered yet. It answers when the cell that runs has ended; " +
  "if the kernel was shut down, run this cell again.";
const ENDS = ["terminating", "restarting", "autorestarting", "dead"]; // of a kernel, in its status

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value);
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

const group = (label, ...children) =>
  make("div", { class: "rb-buttons", role: "group", "aria-label": label }, ...children);

// JupyterLab, where its settings let a page ask it: the notebook that shows an element.

function notebookAround(element) {
  const widgets = window.jupyterapp?.shell.widgets("main") ?? [];
  return Array.from(widgets).find((one) => one.content?.widgets && one.node.contains(element));
}

// Runs the cells of an exercise, and then the one that shows the element; false if nobody can.
async function runCells(element, exercise) {
  const content = notebookAround(element)?.content;
  const cells = content?.widgets ?? [];
  const here = cells.findIndex((cell) => cell.node.contains(element));
  if (here < 0) return false;
  const mine = cells.filter(
    ({ model }, at) =>
      at < here && model.type === "code" && model.getMetadata("rosbeat")?.exercise === exercise,
  );
  for (const cell of [...mine, cells[here]]) {
    content.activeCellIndex = content.widgets.indexOf(cell);
    content.deselectAll();
    await window.jupyterapp.commands.execute("notebook:run-cell");
  }
  return true;
}

// Saves the page on which an exercise has passed: what counts is in the file.
function save(element) {
  const context = notebookAround(element)?.context;
  if (context?.model.dirty && !context.model.readOnly) context.save();
}

// Each kind of widget returns its rows, and what brings them up to date.

function check(model, ask, say, whole) {
  const sure = (open) => {
    row.hidden = open;
    question.hidden = !open;
    (open ? question.querySelector("button") : answer).focus();
  };
  const asks = (what, words) => () => ask({ do: what }, words);
  const answer = button("Show the answer", () => sure(true));
  const again = button("Run again", async () => {
    if (!(await runCells(whole, model.get("exercise")))) {
      ask({ do: "again" }, "Checking ...");
    }
  });
  let isSaved = false;
  const saveOnce = () => {
    if (isSaved || !model.get("passed") || !whole.isConnected) return;
    isSaved = true;
    save(whole);
  };
  requestAnimationFrame(saveOnce); // the page has put it in its place by then
  const row = group(
    `Help with exercise ${model.get("exercise")}`,
    button("Hint", asks("hint", "Looking for a hint ...")),
    answer,
    again,
  );
  const question = group(
    "Show the answer?",
    make("span", {}, "Show the whole answer, and stop looking for it yourself?"),
    button("No, not yet", () => sure(false)),
    button("Yes, show it", () => {
      sure(false);
      ask({ do: "answer" }, "Looking for the answer ...");
    }),
  );
  question.hidden = true;
  const update = () => {
    if (model.get("passed")) question.hidden = true;
    row.hidden = model.get("passed") || !question.hidden;
    answer.hidden = !model.get("has_answer");
    // Where JupyterLab cannot be asked, the kernel judges what the cell defined when it ran last.
    again.textContent = window.jupyterapp ? "Run again" : "Check again";
    again.title = window.jupyterapp
      ? "Runs the cell of the exercise, and then this check"
      : "Checks the cell of the exercise as it last ran";
    saveOnce();
  };
  return { rows: [row, question], update };
}

/** Open what answers a prediction: it is folded in the first text below the cell. */
function unfold(element) {
  let cell = element.closest(".jp-Cell")?.nextElementSibling;
  while (cell?.classList.contains("jp-CodeCell")) cell = cell.nextElementSibling;
  cell?.querySelector("details.rosbeat-answer")?.setAttribute("open", "");
}

function predict(model, ask, say) {
  const field = make("input", {
    type: "text",
    "aria-label": "Your prediction",
    placeholder: model.get("form"),
    autocomplete: "off",
    spellcheck: "false",
  });
  const compare = () =>
    field.value.trim()
      ? ask({ do: "guess", guess: field.value }, "Comparing ...")
      : say("Write what you expect, or choose Show me.");
  field.addEventListener("keydown", (event) => {
    if (event.key === "Enter" && !event.isComposing) compare();
  });
  const row = group(
    "Predict",
    make("span", {}, "What do you expect?"),
    field,
    button("Compare", compare),
    button("Show me", () => ask({ do: "show" }, "")),
  );
  const update = () => {
    row.hidden = model.get("passed");
    if (row.hidden) unfold(row);
  };
  return { rows: [row], update };
}

const LOOKS = { "\u2713": "rb-right", "\u2717": "rb-wrong" }; // of the signs of `outcome_display`

function quiz(model, ask) {
  const draw = ({ id, choices }, question) => {
    const head = make("p");
    const reason = make("p", { role: "status" });
    const buttons = choices.map((_, choice) =>
      button("", () => ask({ do: "choose", question, choice }, "")),
    );
    const whole = make("div", { role: "group", "aria-label": `Question ${id}` });
    whole.append(head, ...buttons, reason);
    return { whole, head, reason, buttons };
  };
  const rows = model.get("questions").map(draw);
  const update = () =>
    model.get("questions").forEach(({ id, sign, text, choices, chosen, reason }, number) => {
      const row = rows[number];
      row.whole.className = `rb-question ${LOOKS[sign] || ""}`;
      row.head.innerHTML = `<strong>${sign} Question ${id}: ${text}</strong>`;
      row.buttons.forEach((one, choice) => {
        const isChosen = chosen === choice;
        one.setAttribute("aria-pressed", isChosen);
        one.innerHTML = isChosen ? `${sign} ${choices[choice]}` : choices[choice];
      });
      // A screen reader says a status again when it is written again.
      if (row.reason.dataset.said !== reason) row.reason.innerHTML = reason;
      row.reason.dataset.said = reason;
    });
  return { rows: rows.map(({ whole }) => whole), update };
}

/** Mark what is on the page as gone when its kernel ends; return what stops the watching. */
function watch(model, whole) {
  const kernel = model.widget_manager?.kernel; // other front ends may have no such thing
  const end = () => whole.classList.add("rb-orphan");
  const hear = (_, status) => ENDS.includes(status) && end();
  kernel?.disposed?.connect(end);
  kernel?.statusChanged?.connect(hear);
  return () => {
    kernel?.disposed?.disconnect(end);
    kernel?.statusChanged?.disconnect(hear);
  };
}

function render({ model, el }) {
  const kind = model.get("kind");
  const status = make("div", { role: "status", tabindex: -1 });
  const whole = make("div", { class: `rosbeat-exercise rosbeat-${kind}` });
  let timer = 0;
  let waitsFor = 0;
  let meanwhile = "";

  const say = (text) => (status.textContent = text);
  function update() {
    for (const one of whole.querySelectorAll("button")) {
      one.setAttribute("aria-disabled", waitsFor > model.get("done"));
    }
    shown.update();
  }
  function ask(message, words) {
    if (waitsFor > model.get("done")) return;
    waitsFor = model.get("done") + 1;
    say((meanwhile = words));
    update();
    clearTimeout(timer);
    timer = setTimeout(() => {
      say(SILENCE);
      waitsFor = 0;
      update();
    }, PATIENCE);
    model.send(message);
  }
  function begin() {
    clearTimeout(timer);
    say(meanwhile);
  }
  function hear() {
    const hadFocus = whole.contains(document.activeElement);
    clearTimeout(timer);
    update();
    status.innerHTML = model.get("said");
    if (hadFocus && kind !== "quiz" && model.get("passed")) status.focus();
  }

  const shown = { check, predict, quiz }[kind](model, ask, say, whole);
  whole.append(...shown.rows, status);
  el.append(whole);
  hear();
  requestAnimationFrame(shown.update); // now it has a place on the page
  const unwatch = watch(model, whole);
  model.on("change:begun", begin);
  model.on("change:done", hear);
  return () => {
    unwatch();
    clearTimeout(timer);
    model.off("change:begun", begin);
    model.off("change:done", hear);
  };
}

export default { render };

// The buttons below the questions of a page: one for each choice. The answer appears in the card
// above, and its words are read out by screen readers.

const PATIENCE = 5000; // milliseconds after which the page says that the kernel has not answered
const SILENCE =
  "The kernel has not answered yet. It answers when the cell that runs has ended; " +
  "if the kernel was restarted, run this cell again.";

function render({ model, el }) {
  const whole = document.createElement("div");
  whole.className = "rosbeat-exercise rosbeat-quiz";
  const status = document.createElement("p");
  status.setAttribute("role", "status");
  const rows = JSON.parse(model.get("questions")).map((question, number) => {
    const row = document.createElement("div");
    row.className = "rb-buttons";
    row.setAttribute("role", "group");
    row.setAttribute("aria-label", `Question ${question.id}`);
    const label = document.createElement("span");
    label.textContent = `Question ${question.id}:`;
    row.append(label);
    question.choices.forEach((choice, index) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = choice[0];
      button.title = choice;
      button.setAttribute("aria-label", choice);
      // JupyterLab's one-letter commands do not apply to it.
      button.setAttribute("data-lm-suppress-shortcuts", "true");
      button.addEventListener("click", () => choose(number, index));
      row.append(button);
    });
    return row;
  });
  let timer = 0;

  function choose(question, choice) {
    clearTimeout(timer);
    timer = setTimeout(() => (status.textContent = SILENCE), PATIENCE);
    model.send({ do: "choose", question, choice });
  }
  function update() {
    JSON.parse(model.get("questions")).forEach((question, number) => {
      rows[number].querySelectorAll("button").forEach((button, index) => {
        button.setAttribute("aria-pressed", question.chosen === index ? "true" : "false");
      });
    });
  }
  function hear() {
    clearTimeout(timer);
    update();
    status.textContent = model.get("said");
  }
  model.on("change:done", hear);
  whole.append(...rows, status);
  el.append(whole);
  update();
  return () => {
    clearTimeout(timer);
    model.off("change:done", hear);
  };
}

export default { render };

// The list of `progress()`, as the kernel makes it, and shown as JupyterLab shows HTML: links open
// pages beside this one. A view asks for the list when it is drawn, so that a page which is opened
// has the list without running its cell.

const ENDS = ["terminating", "restarting", "autorestarting", "dead"]; // of a kernel, in its status
const GONE = "The kernel has ended or started anew. Run this cell to bring the list up to date.";

async function render({ model, el }) {
  const { kernel, rendermime } = model.widget_manager ?? {}; // other front ends may have neither
  const whole = document.createElement("div");
  whole.className = "rosbeat-progress-live";
  el.append(whole);
  async function draw() {
    const html = model.get("html");
    if (!html) return;
    if (!rendermime) return void (whole.innerHTML = html);
    const output = rendermime.createRenderer("text/html");
    await output.renderModel(rendermime.createModel({ trusted: true, data: { "text/html": html } }));
    whole.replaceChildren(output.node);
  }
  function end() {
    const last = document.createElement("p");
    last.textContent = GONE;
    if (!whole.textContent.endsWith(GONE)) whole.append(last);
  }
  const hear = (_, status) => ENDS.includes(status) && end();
  model.on("change:html", draw);
  kernel?.disposed?.connect(end);
  kernel?.statusChanged?.connect(hear);
  await draw();
  model.send({ do: "show" });
  return () => {
    model.off("change:html", draw);
    kernel?.disposed?.disconnect(end);
    kernel?.statusChanged?.disconnect(hear);
  };
}

export default { render };

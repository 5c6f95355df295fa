// The instrument panel in the browser: frames in, a picture and clicks out.
//
// Each widget has one store, which all of its views draw from. A frame changes the store at once;
// the views are drawn when the browser is ready to paint, so a tab that sleeps costs nothing and
// is right again with its next paint.

const SPAN = 30; // seconds of a strip chart
const MOST_LINES = 500;
const LEVELS = ["DEBUG", "INFO", "WARN", "ERROR", "FATAL"];
const PAINT_EVERY = 30; // milliseconds: a little more often than frames come
const PULSE = 400; // milliseconds from one end of an arrow to the other
const PULSE_GAP = 90; // milliseconds between two pulses on one arrow
const WATCH_EVERY = 400; // milliseconds from one look for news to the next
const MOST_QUIET = 6; // looks without news: the kernel sends something at least once a second
const LOST =
  "No news from the kernel. If it has started anew, choose Run, Run All Above Selected Cell in the " +
  "menu, then run this cell again.";
// Drawn here, since fonts show some of these signs as coloured emoji.
const ICONS = {
  running: "M4 2.5L13 8L4 13.5z",
  paused: "M4 3h3v10h-3zM9 3h3v10h-3z",
  stopped: "M3.5 3.5h9v9h-9z",
  ended: "M3 5L5 3L8 6L11 3L13 5L10 8L13 11L11 13L8 10L5 13L3 11L6 8z",
  "not added": "M8 3a5 5 0 1 0 .01 0zM8 5a3 3 0 1 1 -.01 0z",
};

const CONTROLS = ["button", "input", "select"];

// Small tools.

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, value);
  }
  // JupyterLab's one-letter commands, such as the two d that delete a cell, do not apply here; it
  // looks for this on the element itself.
  if (CONTROLS.includes(tag) || "tabindex" in attributes) {
    element.setAttribute("data-lm-suppress-shortcuts", "true");
  }
  element.append(...children);
  return element;
}

function draw(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function icon(condition) {
  const path = draw("path", { d: ICONS[condition] || ICONS.ended });
  return draw("svg", { viewBox: "0 0 16 16", class: "rb-icon", "aria-hidden": "true" }, path);
}

function options(select, values, label = (value) => value) {
  const chosen = select.value;
  select.replaceChildren(...values.map((value) => make("option", { value }, label(value))));
  if (values.includes(chosen)) select.value = chosen;
}

const short = (seconds) => seconds.toFixed(1);

// The store: what is known of the session.

function newStore() {
  return {
    number: 0,
    since: 0,
    time: 0,
    heardAt: 0,
    live: false,
    closed: false,
    quiet: 0, // looks since the kernel last sent something
    note: "",
    frames: 0,
    graph: null,
    nodes: {},
    topics: {},
    log: [],
    views: new Set(),
  };
}

/** Notice a kernel that is gone: count looks without news, since a tab that slept had none to take. */
function watch(store) {
  const timer = setInterval(() => {
    if (!store.number || store.closed) return;
    store.quiet += 1;
    if (store.quiet === MOST_QUIET) tell(store, { kind: "lost" });
  }, WATCH_EVERY);
  return () => clearInterval(timer);
}

const isLost = (store) => store.quiet >= MOST_QUIET;
const isIdle = (store) => !store.live || store.closed || isLost(store);

function takeFrame(store, frame, send) {
  const was_lost = isLost(store);
  store.quiet = 0;
  if (was_lost) tell(store, { kind: "found" });
  if (frame.closed) {
    store.closed = true;
    return tell(store, { kind: "closed" });
  }
  if (!frame.whole && frame.number !== store.number + 1) {
    if (Date.now() - store.since > 1000) send({ do: "open" });
    store.since = Date.now();
    return;
  }
  const pause = Date.now() - store.heardAt;
  store.number = frame.number;
  store.heardAt = Date.now();
  store.frames += 1;
  if (frame.whole || frame.number % 3 === 0 || pause > 300) send({ got: frame.number });
  if (frame.whole) Object.assign(store, { topics: {}, log: [] });
  for (const part of ["time", "live", "graph", "nodes", "note"]) {
    if (part in frame) store[part] = frame[part];
  }
  for (const [name, news] of Object.entries(frame.topics)) takeTopic(store, name, news);
  const lines = frame.log || [];
  if (frame.left_out) {
    const text = `${frame.left_out} lines are not shown here; ros.logs() has them all.`;
    lines.unshift([frame.time, "INFO", "panel", text]);
  }
  store.log.push(...lines);
  store.log.splice(0, store.log.length - MOST_LINES);
  tell(store, { kind: "frame", frame, lines });
}

function takeTopic(store, name, news) {
  const points = [...(store.topics[name]?.points || []), ...news.points];
  const first = points.findIndex(([at]) => at >= store.time - SPAN);
  store.topics[name] = { ...news, points: first < 0 ? [] : points.slice(first) };
}

function tell(store, event) {
  for (const view of store.views) view(event);
}

// The graph, with pulses.

function graphView() {
  const element = make("div", { class: "rb-graph", tabindex: 0, role: "group", "aria-label": "Graph" });
  let svg = null;
  let pulses = [];
  let edges = [];
  const calm = window.matchMedia("(prefers-reduced-motion: reduce)");

  function build(graph) {
    const size = `0 0 ${graph.width} ${graph.height}`;
    svg = draw("svg", { viewBox: size, role: "img", "aria-label": graph.words });
    svg.style.maxWidth = `${graph.width}px`;
    const head = { id: "rb-head", viewBox: "0 0 10 10", refX: 9, refY: 5, orient: "auto" };
    const marker = { ...head, markerWidth: 7, markerHeight: 7, markerUnits: "userSpaceOnUse" };
    svg.append(draw("defs", {}, draw("marker", marker, draw("path", { d: "M0,1L10,5L0,9z" }))));
    edges = graph.edges.map((edge) => {
      const kind = edge.fault ? "rb-edge rb-broken" : "rb-edge";
      const path = draw("path", { d: edge.path, class: kind, "marker-end": "url(#rb-head)" });
      svg.append(path);
      return { ...edge, element: path, length: 0, last: 0 };
    });
    for (const box of graph.boxes) svg.append(drawBox(box));
    pulses = [];
    element.replaceChildren(svg);
  }

  function drawBox(box) {
    const { x, y, w, h } = box;
    const group = draw("g", { class: `rb-${box.kind}${box.broken ? " rb-broken" : ""}` });
    group.dataset.name = box.name;
    group.append(
      box.kind === "node"
        ? draw("ellipse", { cx: x, cy: y, rx: w / 2, ry: h / 2 })
        : draw("rect", { x: x - w / 2, y: y - h / 2, width: w, height: h, rx: 6 }),
    );
    box.lines.forEach((line, rank) => {
      const at = y + (rank - (box.lines.length - 1) / 2) * 17;
      // A long name takes several lines; only what stands below it, type and fault, is small.
      const kind = rank < box.rows ? "rb-name" : "rb-small";
      group.append(draw("text", { x, y: at, class: kind }, line));
    });
    return group;
  }

  function launch(edge, now, onward) {
    if (edge.fault || now - edge.last < PULSE_GAP) return;
    edge.last = now;
    if (calm.matches) return;
    edge.length = edge.length || edge.element.getTotalLength();
    const pulse = { edge, dot: draw("circle", { r: 5, class: "rb-pulse" }), begin: now, onward };
    // Some screens are drawn before the next paint of ours; without a place it stands in the corner.
    move(pulse, 0);
    svg.append(pulse.dot);
    pulses.push(pulse);
  }

  function move({ edge, dot }, part) {
    const at = edge.element.getPointAtLength(part * edge.length);
    dot.setAttribute("transform", `translate(${at.x},${at.y})`);
  }

  return {
    element,
    frame(store, frame, now) {
      if (frame.graph) build(frame.graph);
      for (const [topic, news] of Object.entries(frame.topics)) {
        for (const node of Object.keys(news.from)) {
          const into = edges.find((e) => e.from === `node ${node}` && e.to === `topic ${topic}`);
          if (into) launch(into, now, `topic ${topic}`);
        }
      }
    },
    paint(store, now) {
      for (const pulse of pulses) {
        const part = (now - pulse.begin) / PULSE;
        if (part >= 1) {
          pulse.dot.remove();
          const next = edges.filter((edge) => edge.from === pulse.onward);
          for (const edge of next) launch(edge, now, "");
        } else {
          move(pulse, Math.max(part, 0)); // the time of a paint may lie before that of a frame
        }
      }
      pulses = pulses.filter((pulse) => now - pulse.begin < PULSE);
      for (const edge of edges) edge.element.classList.toggle("rb-busy", now - edge.last < 250);
      for (const group of element.querySelectorAll(".rb-node")) {
        group.dataset.condition = store.nodes[group.dataset.name] || "running";
      }
    },
    isMoving: () => pulses.length > 0,
    forget() {
      for (const pulse of pulses) pulse.dot.remove();
      pulses = [];
    },
  };
}

// The topics, with a strip chart each.

function topicsView() {
  const rows = {};
  const body = make("tbody");
  const head = ["topic", "newest", "Hz", "count", "last 30 s"];
  const cells = head.map((text) => make("th", { scope: "col" }, text));
  const table = make("table", { class: "rb-topics" }, make("thead", {}, make("tr", {}, ...cells)));
  table.append(body);

  function row(name) {
    const chart = make("canvas", { role: "img" });
    const cells = { value: make("td", { class: "rb-value" }), rate: make("td"), total: make("td") };
    const label = make("th", { scope: "row" }, name);
    body.append(make("tr", {}, label, ...Object.values(cells), make("td", {}, chart)));
    return { ...cells, chart, said: 0 };
  }

  return {
    element: table,
    paint(store, now, colours) {
      for (const [name, topic] of Object.entries(store.topics)) {
        const parts = (rows[name] = rows[name] || row(name));
        set(parts.value, topic.field ? `${topic.field}: ${topic.text}` : topic.text);
        set(parts.rate, short(topic.rate));
        set(parts.total, String(topic.total));
        strip(parts.chart, topic.points, store.time, colours);
        if (now - parts.said > 2000) {
          parts.said = now;
          parts.chart.setAttribute("aria-label", chartWords(name, topic.points));
        }
      }
    },
  };
}

function set(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

function chartWords(name, points) {
  const values = points.map(([, value]) => value).filter((value) => value !== null);
  if (!values.length) return `${name}: no numbers in the last 30 seconds`;
  const [least, most] = [Math.min(...values), Math.max(...values)].map((v) => v.toPrecision(4));
  return `${name} in the last 30 seconds: from ${least} to ${most}`;
}

function strip(canvas, points, time, colours) {
  const [width, height] = [canvas.clientWidth || 240, canvas.clientHeight || 40];
  const scale = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * scale)) {
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
  }
  const pen = canvas.getContext("2d");
  pen.setTransform(scale, 0, 0, scale, 0, 0);
  pen.clearRect(0, 0, width, height);
  const values = points.map(([, value]) => value).filter((value) => value !== null);
  if (!points.length) return;
  const [low, high] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 0];
  const room = high - low || 1;
  const words = 44;
  const x = ([at]) => (width - words - 6) * (1 - (time - at) / SPAN);
  const y = (value) => (high > low ? height - 6 - ((height - 12) * (value - low)) / room : height / 2);
  pen.strokeStyle = pen.fillStyle = colours.line;
  pen.lineWidth = 1.5;
  pen.beginPath();
  let is_down = false;
  for (const point of points) {
    if (point[1] === null) {
      pen.fillStyle = colours.alert;
      pen.fillText("×", x(point) - 3, height / 2 + 4); // not a number
      is_down = false;
    } else {
      if (is_down) pen.lineTo(x(point), y(point[1]));
      else pen.moveTo(x(point), y(point[1]));
      is_down = true;
    }
  }
  pen.stroke();
  const last = points[points.length - 1];
  pen.fillStyle = colours.line;
  if (last[1] !== null) pen.fillRect(x(last) - 2, y(last[1]) - 2, 4, 4);
  if (!values.length) return;
  pen.fillStyle = colours.muted;
  pen.font = "10px sans-serif";
  pen.fillText(high.toPrecision(3), width - words, 10);
  if (high > low) pen.fillText(low.toPrecision(3), width - words, height - 2);
}

// The nodes, with their buttons.

function nodesView(send) {
  const element = make("ul", { class: "rb-nodes" });
  let shown = "";

  function button(words, order, node, disabled) {
    const label = `${words} ${node}`;
    const click = () => send({ do: order, node });
    const look = { type: "button", "aria-label": label, "data-do": order, disabled, onclick: click };
    return make("button", look, words);
  }

  function row(node, condition, store) {
    const off = isIdle(store);
    const rests = condition !== "running";
    const first = rests
      ? button("Resume", "resume", node, off || !["paused", "not added"].includes(condition))
      : button("Pause", "pause", node, off);
    const gone = condition === "stopped" || condition === "ended";
    const second = gone
      ? button("Start", "start", node, off)
      : button("Stop", "stop", node, off);
    const words = make("span", { class: "rb-condition" }, icon(condition), condition);
    const name = make("span", { class: "rb-nodename" }, node);
    return make("li", { "data-node": node, "data-condition": condition }, name, words, first, second);
  }

  return {
    element,
    paint(store) {
      const wanted = JSON.stringify([store.nodes, isIdle(store)]);
      if (wanted === shown) return;
      shown = wanted;
      const focused = element.contains(document.activeElement) ? document.activeElement : null;
      const held = focused?.closest("li")?.dataset.node;
      const which = focused ? [...focused.parentElement.children].indexOf(focused) : -1;
      const nodes = Object.entries(store.nodes);
      element.replaceChildren(...nodes.map(([node, state]) => row(node, state, store)));
      // A button that was clicked is replaced by its opposite; the keyboard stays where it was.
      if (which >= 0) {
        const again = [...element.children].find((item) => item.dataset.node === held);
        again?.children[which]?.focus();
      }
    },
  };
}

// The sliders. What is on one's way is shown; what counts is where the slider is let go.

function slider(label, least, most, step, value, unit, changed) {
  const shown = make("output", {}, `${value}${unit}`);
  const range = { type: "range", min: least, max: most, step, value, "aria-label": label };
  const input = make("input", { ...range, oninput: () => paint(), onchange: () => changed() });
  const paint = () => {
    shown.textContent = `${input.value}${unit}`;
    input.setAttribute("aria-valuetext", shown.textContent);
  };
  paint();
  return { input, element: make("label", {}, make("span", {}, label), input, shown) };
}

function controlsView(send) {
  const topic = make("select", { "aria-label": "Topic", onchange: () => moved() });
  const value = slider("Value", 0, 40, 0.1, 22, "", () => publish());
  const once = make("button", { type: "button", onclick: () => publish() }, "Publish");
  const again = make("input", { type: "checkbox", onchange: () => repeat() });
  const fault = make("select", { "aria-label": "Fault", onchange: () => disturb() });
  options(fault, ["none", "dropout", "nan", "offset"], (kind) => FAULT_WORDS[kind]);
  const amount = slider("Amount", -20, 100, 1, 50, "", () => disturb());
  const busy = slider("Load", 0, 900, 10, 0, " ms", () => load());
  let disturbed = "";
  let repeated = "";

  const publish = () => send({ do: "publish", topic: topic.value, value: +value.input.value });
  const load = () => send({ do: "load", milliseconds: +busy.input.value });
  function repeat() {
    if (repeated) send({ do: "repeat", topic: repeated, on: false });
    repeated = again.checked ? topic.value : "";
    if (repeated) send({ do: "repeat", topic: repeated, on: true, value: +value.input.value });
  }
  function disturb() {
    if (disturbed && disturbed !== topic.value) {
      send({ do: "disturb", topic: disturbed, kind: "none", amount: 0 });
    }
    disturbed = topic.value;
    amount.element.hidden = !["dropout", "offset"].includes(fault.value);
    send({ do: "disturb", topic: disturbed, kind: fault.value, amount: +amount.input.value });
  }
  function moved() {
    if (again.checked) repeat();
    if (fault.value !== "none") disturb();
  }

  amount.element.hidden = true;
  const group = make(
    "fieldset",
    { class: "rb-controls" },
    make("legend", {}, "Inject"),
    make("label", {}, make("span", {}, "Topic"), topic),
    value.element,
    make("div", {}, once, make("label", { class: "rb-check" }, again, "every second")),
    make("label", {}, make("span", {}, "Fault"), fault),
    amount.element,
    busy.element,
  );
  let shown = "";
  return {
    element: group,
    paint(store) {
      const topics = store.graph?.numeric || [];
      if (shown !== topics.join(" ")) options(topic, topics);
      shown = topics.join(" ");
      group.disabled = isIdle(store);
      const nothing = !topics.length;
      for (const part of [topic, value.input, once, again, fault]) part.disabled = nothing;
    },
  };
}

const FAULT_WORDS = {
  none: "none",
  dropout: "lose so many %",
  nan: "NaN as the value",
  offset: "add so much",
};

// The log.

function logView() {
  const node = make("select", { "aria-label": "Log of node", onchange: () => rebuild() });
  const level = make("select", { "aria-label": "Least level", onchange: () => rebuild() });
  const look = { class: "rb-log", role: "log", "aria-label": "Log", "aria-live": "off", tabindex: 0 };
  const list = make("div", look);
  const bar = make("div", { class: "rb-bar" }, make("label", {}, "Node ", node));
  bar.append(make("label", {}, "from level ", level));
  options(node, [""], () => "all");
  options(level, LEVELS, (name) => name.toLowerCase());
  level.value = "INFO";
  const known = new Set();
  let lines = [];

  const fits = ([, how, who]) =>
    (!node.value || node.value === who) && LEVELS.indexOf(how) >= LEVELS.indexOf(level.value);

  function row([at, how, who, text]) {
    const level = make("b", {}, how);
    const row = make("div", { "data-level": how }, level, ` [${at.toFixed(2)}] [${who}]: ${text}`);
    return row;
  }

  function add(some) {
    const is_at_end = list.scrollTop + list.clientHeight >= list.scrollHeight - 8;
    list.append(...some.filter(fits).map(row));
    while (list.childElementCount > MOST_LINES) list.firstElementChild.remove();
    if (is_at_end) list.scrollTop = list.scrollHeight;
  }

  function rebuild() {
    list.replaceChildren();
    add(lines);
    list.scrollTop = list.scrollHeight;
  }

  return {
    element: make("div", { class: "rb-logs" }, bar, list),
    frame(store, frame, fresh) {
      lines = store.log;
      const before = known.size;
      for (const [, , who] of fresh) known.add(who);
      if (known.size > before) {
        options(node, ["", ...[...known].sort()], (name) => name || "all");
      }
      if (frame.whole) rebuild();
      else if (fresh.length) add(fresh);
    },
  };
}

// One view: all of it, on the page.

function build(store, send, el) {
  const [graph, topics, log] = [graphView(), topicsView(), logView()];
  const [nodes, controls] = [nodesView(send), controlsView(send)];
  const state = make("span", { class: "rb-state" });
  const note = make("p", { class: "rb-note", role: "status" });
  const lost = make("p", { class: "rb-lost", role: "alert" });
  const title = make("header", {}, make("strong", {}, "Instrument panel"), state);
  const side = make("div", { class: "rb-side" }, nodes.element, controls.element);
  const main = make("div", { class: "rb-main" }, topics.element, log.element);
  const grid = make("div", { class: "rb-grid" }, main, side);
  const root = make("section", { class: "rosbeat-panel", "aria-label": "Instrument panel" });
  root.append(title, lost, graph.element, grid, note);
  el.append(root);

  let due = 0;
  let painted = 0;
  let dirty = true;
  let asked = 0;

  function paint(now) {
    asked = 0;
    if (!root.isConnected && painted) return; // a view that was taken off the page
    if (now < due) return again();
    due = now + PAINT_EVERY;
    painted += 1;
    dirty = false;
    const style = getComputedStyle(root);
    const colour = (name) => style.getPropertyValue(name).trim();
    const colours = { line: colour("--rb-blue"), alert: colour("--rb-red"), muted: colour("--rb-muted") };
    set(state, stateWords(store));
    set(note, store.note || "");
    set(lost, isLost(store) ? LOST : "");
    root.dataset.frames = store.frames;
    root.dataset.painted = painted;
    graph.paint(store, now);
    topics.paint(store, now, colours);
    nodes.paint(store);
    controls.paint(store);
    if (graph.isMoving() || dirty) again();
  }
  function again() {
    asked = asked || requestAnimationFrame(paint);
  }
  function hear({ kind, frame, lines }) {
    dirty = true;
    if (kind === "frame") {
      if (document.hidden) graph.forget();
      graph.frame(store, frame, performance.now());
      log.frame(store, frame, lines);
    }
    again();
  }
  function comeBack() {
    if (document.hidden) return;
    dirty = true;
    again();
  }

  store.views.add(hear);
  document.addEventListener("visibilitychange", comeBack);
  if (store.graph) {
    const everything = { whole: true, graph: store.graph, topics: {} };
    graph.frame(store, everything, performance.now());
    log.frame(store, everything, store.log);
  }
  again();
  return () => {
    store.views.delete(hear);
    document.removeEventListener("visibilitychange", comeBack);
    cancelAnimationFrame(asked);
    root.remove();
  };
}

function stateWords(store) {
  if (store.closed) return "closed";
  if (isLost(store)) return `stopped at ${short(store.time)} s`;
  if (!store.number) return "waiting for the session …";
  const time = `${short(store.time)} s`;
  return store.live ? `live, ${time}` : `${time}, not live: ros.start() starts the clock`;
}

export default () => {
  const store = newStore();
  return {
    initialize({ model }) {
      const send = sender(model);
      const hear = (frame) => takeFrame(store, frame, send);
      const unwatch = watch(store);
      model.on("msg:custom", hear);
      send({ do: "open" });
      return () => {
        unwatch();
        model.off("msg:custom", hear);
      };
    },
    render({ model, el }) {
      return build(store, sender(model), el);
    },
  };
};

function sender(model) {
  return (content) => {
    try {
      model.send(content);
    } catch {
      // The kernel is gone, and the watch says so.
    }
  };
}

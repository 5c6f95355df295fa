// A robot from above, live: frames in, a picture and commands out.

const WATCH_EVERY = 400; // milliseconds from one look for news to the next
const MOST_QUIET = 8; // looks without a frame: ten come each second
const REPEAT = 200; // milliseconds between commands while a button is held
const TRAIL = 600; // places of the way that are kept
const BODY = 0.17; // meters
const LOST = "No news from the kernel. Run this cell again.";
const KEYS = {
  ArrowUp: ["ahead", 1, 0, "\u2191"],
  ArrowLeft: ["left", 0, 1, "\u2190"],
  ArrowDown: ["back", -1, 0, "\u2193"],
  ArrowRight: ["right", 0, -1, "\u2192"],
};

function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value);
  }
  // JupyterLab's one-letter commands do not apply here; it looks for this on the element itself.
  if (["button", "input"].includes(tag)) element.setAttribute("data-lm-suppress-shortcuts", "true");
  element.append(...children);
  return element;
}

function draw(tag, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...children);
  return element;
}

function path(points) {
  return points.map(([x, y], rank) => `${rank ? "L" : "M"}${x.toFixed(3)} ${y.toFixed(3)}`).join("");
}

// Rows of the map as rectangles, one for each stretch that is occupied.
function roomPath({ width, side, corner, data: cells }) {
  const parts = [];
  for (let row = 0; row < cells.length / width; row++) {
    for (let begin = 0; begin < width; begin++) {
      if (cells[row * width + begin] < 50) continue;
      let end = begin;
      while (end < width && cells[row * width + end] >= 50) end++;
      const [x, y] = [corner[0] + begin * side, corner[1] + row * side];
      parts.push(`M${x} ${y}h${(end - begin) * side}v${side * 1.02}h${(begin - end) * side}z`);
      begin = end;
    }
  }
  return parts.join("");
}

function render({ model, el }) {
  const name = model.get("robot");
  const who = name.charAt(0).toUpperCase() + name.slice(1);
  const room = draw("path", { class: "rv-room" });
  const rays = draw("path", { class: "rv-rays" });
  const seen = draw("path", { class: "rv-seen" });
  const trail = draw("path", { class: "rv-trail" });
  const body = draw(
    "g", { class: "rv-body", visibility: "hidden" },
    draw("circle", { r: BODY }),
    draw("path", { d: `M${BODY * 0.8} 0L${-BODY * 0.55} ${BODY * 0.55}L${-BODY * 0.55} ${-BODY * 0.55}z` }),
    draw("circle", { class: "rv-lamp", cx: BODY * 0.95, r: BODY * 0.35 })
  );
  // Meters, with y up.
  const world = draw("g", { transform: "scale(1 -1)" }, room, rays, seen, trail, body);
  const picture = draw("svg", { role: "img", viewBox: "-0.1 -4.1 6.2 4.2" }, world);
  const lost = make("p", { class: "rv-lost", role: "alert" });
  const words = make("p", { class: "rv-words" });
  const speed = make("input", { type: "range", min: 0.1, max: 1, step: 0.1, value: 0.4, "aria-label": "Speed" });
  const speedWords = make("output", {}, "0.4 m/s");
  speed.addEventListener("input", () => (speedWords.textContent = `${Number(speed.value).toFixed(1)} m/s`));

  // Commands, while a button is held.
  let held = null;
  function tell(ahead, turn) {
    model.send({ do: "drive", ahead, turn });
  }
  function press(key) {
    if (held?.key === key) return;
    release();
    const [, ahead, turn] = KEYS[key];
    const go = () => tell(ahead * Number(speed.value), turn * 1.2);
    held = { key, timer: setInterval(go, REPEAT) };
    buttons[key].classList.add("rv-held");
    go();
  }
  function release() {
    if (!held) return;
    clearInterval(held.timer);
    buttons[held.key].classList.remove("rv-held");
    held = null;
    tell(0, 0);
  }
  const buttons = {};
  for (const [key, [label, , , sign]] of Object.entries(KEYS)) {
    buttons[key] = make("button", { type: "button", "aria-label": `Drive ${label}`, title: `Drive ${label}`, class: `rv-${label}` }, sign);
    buttons[key].addEventListener("pointerdown", (event) => {
      buttons[key].setPointerCapture?.(event.pointerId);
      press(key);
    });
    for (const ending of ["pointerup", "pointercancel", "blur"]) buttons[key].addEventListener(ending, release);
  }
  const pad = make("div", { class: "rv-pad", role: "group", "aria-label": `Drive ${who}` }, ...Object.values(buttons));
  pad.addEventListener("keydown", (event) => {
    const chosen = Object.keys(buttons).find((key) => buttons[key] === event.target);
    const key = event.key in KEYS ? event.key : [" ", "Enter"].includes(event.key) ? chosen : undefined;
    if (!key) return;
    event.preventDefault();
    event.stopPropagation();
    press(key);
  });
  pad.addEventListener("keyup", release);
  const controls = make("div", { class: "rv-controls" }, pad, make("label", {}, "Speed ", speed, speedWords));
  el.append(
    make("section", { class: "rosbeat-robot", "aria-label": `${who}, live` }, lost, picture, make("div", { class: "rv-foot" }, words, controls))
  );
  const section = el.querySelector(".rosbeat-robot");

  // Frames.
  let quiet = 0;
  let frames = 0;
  let way = [];
  function hear(frame) {
    quiet = 0;
    lost.textContent = "";
    model.send({ got: frame.number });
    section.dataset.frames = ++frames;
    if (frame.map) {
      const { width, side, corner, data } = frame.map;
      const high = (data.length / width) * side;
      room.setAttribute("d", roomPath(frame.map));
      picture.setAttribute("viewBox", `${corner[0] - 0.1} ${-corner[1] - high - 0.1} ${width * side + 0.2} ${high + 0.2}`);
    }
    body.setAttribute("visibility", frame.pose ? "visible" : "hidden");
    for (const button of Object.values(buttons)) button.disabled = !frame.pose;
    if (!frame.pose) {
      way = [];
      rays.setAttribute("d", "");
      seen.setAttribute("d", "");
      trail.setAttribute("d", "");
      tellWords(`${who} is not here yet. Start her in a terminal: ros2 run ${name} rover`);
      return;
    }
    const [x, y, theta] = frame.pose;
    const [lastX, lastY] = way[way.length - 1] || [];
    if (Math.hypot(x - lastX, y - lastY) > 1) way = []; // put somewhere else
    if (lastX !== x || lastY !== y) way.push([x, y]);
    if (way.length > TRAIL) way.shift();
    trail.setAttribute("d", way.length > 1 ? path(way) : "");
    body.setAttribute("transform", `translate(${x} ${y}) rotate(${(theta * 180) / Math.PI})`);
    body.classList.toggle("rv-lit", Boolean(frame.lamp));
    const ends = frame.scan.map(([angle, range]) => [x + range * Math.cos(theta + angle), y + range * Math.sin(theta + angle)]);
    rays.setAttribute("d", ends.map((end) => path([[x, y], end])).join(""));
    seen.setAttribute("d", ends.map(([a, b]) => `M${a - 0.03} ${b}h0.06M${a} ${b - 0.03}v0.06`).join(""));
    const degrees = ((Math.round((theta * 180) / Math.PI) % 360) + 360) % 360;
    const warmth = frame.temperature === null ? "" : ` \u00b7 ${frame.temperature.toFixed(1)} \u00b0C`;
    tellWords(`x ${x.toFixed(2)} m \u00b7 y ${y.toFixed(2)} m \u00b7 ${degrees}\u00b0${warmth}`);
  }
  function tellWords(text) {
    words.textContent = text;
    picture.setAttribute("aria-label", `${who} from above. ${text}`);
  }
  const listen = (content) => hear(content);
  model.on("msg:custom", listen);
  tellWords(`Looking for ${who} ...`);
  const watch = setInterval(() => {
    if (++quiet > MOST_QUIET * 3 || (frames && quiet > MOST_QUIET)) {
      lost.textContent = LOST;
      for (const button of Object.values(buttons)) button.disabled = true;
    }
  }, WATCH_EVERY);
  model.send({ do: "open" });
  return () => {
    release();
    clearInterval(watch);
    model.off("msg:custom", listen);
    model.send({ do: "close" });
  };
}

export default { render };

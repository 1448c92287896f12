// Shows the present instruction of the app and sends what the participant does. Asks again every 0.7 s, so that it continues by
// itself when the network was gone. Keeps nothing.
"use strict";

const pollMs = 700, waitMs = 4000;
const page = document.getElementById("page"), offline = document.getElementById("offline");
let words = null, shown = "", number = 0, breakBegan = 0, clock = null, hasDeclined = false;  // what the page shows

async function ask(path, body) {
  const aborting = new AbortController(), timer = setTimeout(() => aborting.abort(), waitMs);
  const post = {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)};
  try {
    const options = body === undefined ? {} : post;
    const reply = await fetch(path, {...options, signal: aborting.signal, cache: "no-store", redirect: "error"});
    const text = await reply.text();
    const isJson = (reply.headers.get("Content-Type") || "").startsWith("application/json");
    return {status: reply.status, json: isJson ? JSON.parse(text) : null};
  } finally {
    clearTimeout(timer);
  }
}

function element(tag, text, className) {
  const made = document.createElement(tag);
  if (text) made.textContent = text;
  if (className) made.className = className;
  return made;
}

function word(key) { return (words && words.texts[key]) || ""; }

function button(text, className, act) {
  const made = element("button", text, className);
  made.type = "button";
  made.addEventListener("click", act);
  return made;
}

function put(isLarge, ...parts) {
  page.className = isLarge ? "large" : "";
  page.replaceChildren(...parts.filter(part => part));
  const title = page.querySelector("h1");
  if (title) title.tabIndex = -1;
  window.scrollTo(0, 0);
  const field = page.querySelector("input");
  if (field && field.className === "code") field.focus();
  else if (title) title.focus({preventScroll: true});
}

function actions(...buttons) {
  const row = element("div", "", "actions");
  row.append(...buttons);
  return row;
}

async function send(act) {
  page.querySelectorAll("button").forEach(one => { one.disabled = true; });
  try {
    await ask("/act", {number, ...act});
  } catch (fault) {
    showOffline(true);
  }
  setTimeout(() => page.querySelectorAll("button").forEach(one => { one.disabled = one.dataset.off === "1"; }), pollMs * 2);
  setTimeout(poll, 100);
}

// ---- the code
let refusedBecause = "", note = null;
function showCode(why) {
  const because = why === word("code_text") ? "" : why;
  if (shown === "code" && because === refusedBecause) return;
  refusedBecause = because;
  if (shown === "code") {
    note.textContent = because;
    return;
  }
  shown = "code";
  const form = document.createElement("form");
  const label = document.createElement("label"), field = document.createElement("input");
  note = element("p", because, "note wrong");
  field.className = "code";
  field.inputMode = "numeric";
  field.autocomplete = "one-time-code";
  field.maxLength = 20;
  label.append(element("span", word("code_field")), field);
  const enter = element("button", word("code_enter"), "main");
  enter.type = "submit";
  form.append(label, note, actions(enter));
  form.addEventListener("submit", async event => {
    event.preventDefault();
    enter.disabled = true;
    try {
      const reply = await ask("/enter", {code: field.value.replace(/\s/g, "")});
      note.textContent = reply.status === 204 ? "" : (reply.json && reply.json.why) || word("code_wrong");
      if (reply.status === 204) shown = "";
      else field.select();
    } catch (fault) {
      showOffline(true);
    }
    enter.disabled = false;
    poll();
  });
  put(false, element("h1", word("code_title")), element("p", word("code_text")), form);
}

// ---- the pages of the session
function consentParts(instruction) {
  if (hasDeclined)
    return [element("h1", word("declined_title")), element("p", word("declined_text")),
            actions(button(word("back"), "", () => { hasDeclined = false; show(instruction); }))];
  const decline = () => { send({agrees: false}); hasDeclined = true; show(instruction); };
  return [element("div", instruction.statement, "statement"),
          actions(button(word("agree"), "main", () => send({agrees: true})), button(word("decline"), "", decline))];
}

function factsParts(instruction) {
  const fields = instruction.questions.map(question => {
    const label = document.createElement("label"), field = document.createElement("input");
    field.maxLength = 250;
    field.autocomplete = "off";
    label.append(element("span", question), field);
    return {label, field};
  });
  const form = element("form", "", "facts");
  const done = element("button", word("send"), "main");
  done.type = "submit";
  form.append(...fields.map(one => one.label), actions(done));
  form.addEventListener("submit", event => {
    event.preventDefault();
    send({facts: fields.map(one => one.field.value.trim())});
  });
  return [form];
}

function drawn(tag, attributes) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  return made;
}

function scaleParts(scale) {
  const margin = 6, span = scale.max - scale.min;
  const percent = tenths => margin + (100 - 2 * margin) * (tenths - scale.min) / span;
  const area = element("div", "", "tap"), picture = drawn("svg", {"aria-hidden": "true"});
  const rule = (x1, y1, x2, y2) => picture.append(drawn("line", {x1: x1 + "%", y1: y1 + "%", x2: x2 + "%", y2: y2 + "%", class: "rule"}));
  rule(margin, 50, 100 - margin, 50);
  for (let tick = 0; tick <= scale.sections; ++tick) {
    const at = margin + (100 - 2 * margin) * tick / scale.sections, half = tick === 0 || tick === scale.sections ? 26 : 14;
    rule(at, 50 - half, at, 50 + half);
  }
  area.append(picture);
  const ends = element("div", "", "ends");
  ends.append(element("span", scale.low), element("span", scale.high));
  const last = scale.last;
  const note = element("p", last ? (last.is_right ? "✓ " : "✗ ") + last.text : "", "note" + (last ? (last.is_right ? " right" : " wrong") : ""));
  const count = element("p", scale.count, "count");
  if (last) picture.append(drawn("circle", {cx: percent(last.shown) + "%", cy: "50%", r: "0.85rem", class: "place"}));
  if (scale.asked === undefined) return [note, area, ends, count];

  let tapped = null;
  const mark = drawn("circle", {cy: "50%", r: "0.75rem", class: "mark", visibility: "hidden"});
  picture.append(mark);
  const done = button(word("send"), "main", () => send({tapped}));
  done.disabled = true;
  done.dataset.off = "1";
  const choose = tenths => {
    const steps = Math.round((tenths - scale.min) / scale.step);
    tapped = Math.min(scale.max, Math.max(scale.min, scale.min + scale.step * steps));
    picture.querySelectorAll(".place").forEach(one => one.remove());
    mark.setAttribute("cx", percent(tapped) + "%");
    mark.setAttribute("visibility", "visible");
    done.disabled = false;
    done.dataset.off = "0";
  };
  const chooseAt = event => {
    const box = area.getBoundingClientRect(), inset = box.width * margin / 100;
    choose(scale.min + span * (event.clientX - box.left - inset) / (box.width - 2 * inset));
  };
  area.tabIndex = 0;
  area.setAttribute("role", "slider");
  area.setAttribute("aria-label", scale.tap);
  area.addEventListener("pointerdown", event => { area.setPointerCapture(event.pointerId); chooseAt(event); });
  area.addEventListener("pointermove", event => { if (event.buttons) chooseAt(event); });
  area.addEventListener("keydown", event => {
    const way = {ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1}[event.key];
    if (!way) return;
    event.preventDefault();
    choose((tapped === null ? scale.min + scale.step * Math.round(span / 2 / scale.step) : tapped) + way * scale.step);
  });
  return [note, element("p", scale.tap, "ask"), area, ends, count, actions(done)];
}

function breakParts(instruction) {
  const text = element("p", "", "clock");
  const tick = () => {
    const seconds = Math.max(0, Math.floor((performance.now() - breakBegan) / 1000));
    const time = Math.floor(seconds / 60) + ":" + String(seconds % 60).padStart(2, "0");
    text.textContent = instruction.break_clock.replace("{time}", time);
  };
  text.setAttribute("aria-live", "off");
  tick();
  clock = setInterval(tick, 250);
  return [text];
}

function show(instruction) {
  clearInterval(clock);
  const parts = [element("h1", instruction.title), ...instruction.lines.map(line => element("p", line))];
  if (instruction.task === "consent" && hasDeclined) return put(false, ...consentParts(instruction));
  if (instruction.task === "consent") parts.push(...consentParts(instruction));
  if (instruction.task === "facts") parts.push(...factsParts(instruction));
  if (instruction.task === "scale") parts.push(...scaleParts(instruction.scale));
  if (instruction.break_seconds !== undefined) parts.push(...breakParts(instruction));
  put(instruction.task === "read", ...parts);
}

function take(present) {
  const {break_seconds: seconds, ...rest} = present.instruction;
  if (seconds !== undefined) breakBegan = performance.now() - seconds * 1000;
  const key = present.number + JSON.stringify(rest);
  if (key === shown) return;
  shown = key;
  number = present.number;
  hasDeclined = false;
  show(present.instruction);
}

function showOffline(isOffline) {
  offline.textContent = word("no_connection") || "There is no connection.";
  offline.hidden = !isOffline;
}

let isPolling = false;
async function poll() {
  if (isPolling) return;
  isPolling = true;
  try {
    if (!words || !words.texts.code_title) {
      words = (await ask("/words")).json;
      document.documentElement.lang = words.language;
    }
    const reply = await ask("/now");
    showOffline(false);
    if (reply.status === 200) take(reply.json);
    else if (reply.status === 401) showCode(reply.json.why);
  } catch (fault) {
    showOffline(true);
  }
  isPolling = false;
}

setInterval(poll, pollMs);
document.addEventListener("visibilitychange", poll);
poll();

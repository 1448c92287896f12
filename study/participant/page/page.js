// Shows the present instruction of the app and sends what the participant does. Asks again every 0.7 s, so that it continues by
// itself when the network was gone. Keeps nothing. Tablets are old: no syntax and no call is younger than 2018.
"use strict";

const pollMs = 700, waitMs = 4000, holdMs = 700;
const page = document.getElementById("page"), bar = document.getElementById("offline");
let words = null, shown = "", number = 0, breakBegan = 0, clock = null, hasDeclined = false;  // what the page shows

async function answered(path, options) {
  const reply = await fetch(path, options);
  const text = await reply.text();
  const isJson = (reply.headers.get("Content-Type") || "").startsWith("application/json");
  return {status: reply.status, json: isJson ? JSON.parse(text) : null};
}

// Status 0: no answer came.
async function ask(path, body) {
  const aborting = typeof AbortController === "function" ? new AbortController() : null;
  const options = {cache: "no-store", credentials: "same-origin", redirect: "error"};
  if (aborting) options.signal = aborting.signal;
  if (body !== undefined)
    Object.assign(options, {method: "POST", headers: {"Content-Type": "application/json"}, body: JSON.stringify(body)});
  let timer = null;
  const late = new Promise((give, refuse) => {
    timer = setTimeout(() => {
      if (aborting) aborting.abort();
      refuse(new Error("late"));
    }, waitMs);
  });
  try {
    return await Promise.race([answered(path, options), late]);
  } catch (fault) {
    return {status: 0, json: null};
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

const inEnglish = {no_connection: "There is no connection.", too_old: "This browser is too old for this page."};
function showFault(key) {
  bar.textContent = key ? word(key) || inEnglish[key] : "";
  bar.hidden = !key;
}

function button(text, className, act) {
  const made = element("button", text, className);
  made.type = "button";
  made.addEventListener("click", act);
  return made;
}

// ---- buttons: a second tap must not act on the page that follows
let heldUntil = 0, pagesShown = 0;
function isHeld() { return performance.now() < heldUntil; }

function setButtons() {
  page.querySelectorAll("button").forEach(one => { one.disabled = isHeld() || one.dataset.off === "1"; });
}

function hold(ms) {
  heldUntil = performance.now() + ms;
  setButtons();
  if (ms < Infinity) setTimeout(setButtons, ms + 10);
}

function turn(one, isOn) {
  one.dataset.off = isOn ? "0" : "1";
  setButtons();
}

function put(isLarge, parts) {
  ++pagesShown;
  page.className = isLarge ? "large" : "";
  page.textContent = "";
  page.append(...parts.filter(part => part));
  hold(holdMs);
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

// What became of the last act; nothing where it was taken.
function report(text) {
  const before = page.querySelector(".fault");
  if (before) before.remove();
  if (!text) return;
  const line = element("p", text, "note wrong fault");
  line.setAttribute("role", "alert");
  page.append(line);
}

// Returns the status of the reply; 0 where nothing was sent.
async function send(act) {
  if (isHeld()) return 0;
  const sentFrom = pagesShown;
  hold(Infinity);
  report("");
  const status = (await ask("/act", Object.assign({number}, act))).status;
  setTimeout(poll, 100);
  if (sentFrom !== pagesShown) return status;  // the next page is there already
  hold(status === 204 ? 2 * pollMs : 0);       // it comes meanwhile
  if (status === 0) showFault("no_connection");
  const isRefused = status === 400 || status === 413;
  if (status !== 204 && status !== 409) report(word(isRefused ? "not_taken" : "not_sent"));
  return status;
}

// ---- the code
// The zeros of the digits that keyboards of other scripts write; the other nine follow each of them.
const zeros = [0x0660, 0x06f0, 0x07c0, 0x0966, 0x09e6, 0x0a66, 0x0ae6, 0x0b66, 0x0be6, 0x0c66, 0x0ce6, 0x0d66, 0x0de6, 0x0e50,
               0x0ed0, 0x0f20, 0x1040, 0x1090, 0x17e0, 0x1810, 0x1946, 0x19d0, 0x1a80, 0x1a90, 0x1b50, 0x1bb0, 0x1c40, 0x1c50,
               0xa620, 0xa8d0, 0xa900, 0xa9d0, 0xa9f0, 0xaa50, 0xabf0, 0xff10];
function codeIn(typed) {
  const digits = typed.split("").map(sign => {
    const place = sign.charCodeAt(0), zero = zeros.find(one => place >= one && place < one + 10);
    return zero === undefined ? sign : String(place - zero);
  });
  return digits.join("").replace(/[\s\u061c\u200e\u200f\u202a-\u202e\u2066-\u2069]/g, "");
}

let refusedBecause = "", note = null;
function showCode(why) {
  const because = why === word("code_text") ? "" : why;
  if (shown === "code" && because === refusedBecause) return;
  refusedBecause = because;
  if (shown === "code") {
    note.textContent = because;
    return;
  }
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
    turn(enter, false);
    const reply = await ask("/enter", {code: codeIn(field.value)});
    turn(enter, true);
    const isAnswered = reply.status === 204 || reply.status === 400 || (reply.json && reply.json.why);
    if (!isAnswered) return showFault("no_connection");
    note.textContent = reply.status === 204 ? "" : (reply.json && reply.json.why) || word("code_wrong");
    if (reply.status === 204) shown = "";
    else field.select();
    poll();
  });
  put(false, [element("h1", word("code_title")), element("p", word("code_text")), form]);
  shown = "code";
}

// ---- the pages of the session
function consentParts(instruction) {
  if (hasDeclined)
    return [element("h1", word("declined_title")), element("p", word("declined_text")),
            actions(button(word("back"), "", () => { hasDeclined = false; show(instruction); }))];
  const decline = async () => {
    const sentFrom = pagesShown;
    if (await send({agrees: false}) !== 204 || sentFrom !== pagesShown) return;
    hasDeclined = true;
    show(instruction);
  };
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
  done.dataset.off = "1";
  const choose = tenths => {
    const steps = Math.round((tenths - scale.min) / scale.step);
    tapped = Math.min(scale.max, Math.max(scale.min, scale.min + scale.step * steps));
    picture.querySelectorAll(".place").forEach(one => one.remove());
    mark.setAttribute("cx", percent(tapped) + "%");
    mark.setAttribute("visibility", "visible");
    turn(done, true);
  };
  const chooseAt = event => {
    const box = area.getBoundingClientRect(), inset = box.width * margin / 100;
    choose(scale.min + span * (event.clientX - box.left - inset) / (box.width - 2 * inset));
  };
  area.tabIndex = 0;
  area.setAttribute("role", "slider");
  area.setAttribute("aria-label", scale.tap);
  if (window.PointerEvent) {
    area.addEventListener("pointerdown", event => { area.setPointerCapture(event.pointerId); chooseAt(event); });
    area.addEventListener("pointermove", event => { if (event.buttons) chooseAt(event); });
  } else {
    area.addEventListener("click", chooseAt);
  }
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
  if (instruction.task === "consent" && hasDeclined) return put(false, consentParts(instruction));
  if (instruction.task === "consent") parts.push(...consentParts(instruction));
  if (instruction.task === "facts") parts.push(...factsParts(instruction));
  if (instruction.task === "scale") parts.push(...scaleParts(instruction.scale));
  if (instruction.break_seconds !== undefined) parts.push(...breakParts(instruction));
  put(instruction.task === "read", parts);
}

function take(present) {
  const timeless = Object.assign({}, present.instruction), seconds = timeless.break_seconds;
  delete timeless.break_seconds;
  if (seconds !== undefined) breakBegan = performance.now() - seconds * 1000;
  const key = present.number + JSON.stringify(timeless);
  if (key === shown) return;
  number = present.number;
  hasDeclined = false;
  show(present.instruction);
  shown = key;
}

// False: there is no connection.
async function refresh() {
  const reply = await ask("/now");
  // The login page of a guest network and a proxy answer, too.
  if ((reply.status !== 200 && reply.status !== 401) || !reply.json || !reply.json.words) return false;
  if (!words || words.name !== reply.json.words) {  // another study, or another language
    const fetched = await ask("/words");
    if (fetched.status !== 200 || !fetched.json || !fetched.json.texts) return false;
    words = fetched.json;
    document.documentElement.lang = words.language;
    shown = "";
  }
  if (reply.status === 200) take(reply.json);
  else showCode(reply.json.why);
  return true;
}

page.textContent = "";  // the sentence for browsers that cannot run this
let isPolling = false;
async function poll() {
  if (isPolling) return;
  isPolling = true;
  try {
    showFault(await refresh() ? "" : "no_connection");
  } catch (fault) {
    showFault("too_old");  // no fault of the network comes here
  }
  isPolling = false;
}

setInterval(poll, pollMs);
document.addEventListener("visibilitychange", poll);
poll();

// Runs the participant's page on a clock that the test moves, with the few parts of a browser that the page uses, and a network
// that the test holds. page_program_test starts it: node page_in_node.js SOURCE_OF_THE_PAGE SCENARIO. Ends with 1 where a
// scenario fails.
"use strict";

const fs = require("fs"), vm = require("vm"), assert = require("assert");
const [source, scenario] = process.argv.slice(2);

class Element {
  constructor(tag) {
    Object.assign(this, {tag, children: [], parent: null, own: "", className: "", dataset: {}, listeners: {}, attributes: {},
                         disabled: false, value: ""});
  }
  append(...parts) { parts.forEach(part => { part.parent = this; this.children.push(part); }); }
  remove() { if (this.parent) this.parent.children = this.parent.children.filter(one => one !== this); }
  get textContent() { return this.own + this.children.map(one => one.textContent).join(""); }
  set textContent(text) { this.children = []; this.own = text; }
  setAttribute(name, value) { this.attributes[name] = value; }
  addEventListener(name, act) { this.listeners[name] = act; }
  querySelectorAll(wanted) {
    const isIt = one => wanted[0] === "." ? one.className.split(" ").includes(wanted.slice(1)) : one.tag === wanted;
    return this.children.flatMap(one => (isIt(one) ? [one] : []).concat(one.querySelectorAll(wanted)));
  }
  querySelector(wanted) { return this.querySelectorAll(wanted)[0] || null; }
  getBoundingClientRect() { return {left: 0, width: 100}; }
  setPointerCapture() {}
  focus() {}
  select() {}
}

// ---- the clock
let nowMs = 0, timers = [], lastTimer = 0;
function addTimer(act, ms, everyMs) { timers.push({id: ++lastTimer, at: nowMs + ms, act, everyMs}); return lastTimer; }
function settle() { return new Promise(done => setImmediate(() => setImmediate(done))); }
async function wait(ms) {
  const end = nowMs + ms;
  await settle();
  for (;;) {
    const next = timers.filter(one => one.at <= end).sort((a, b) => a.at - b.at || a.id - b.id)[0];
    if (!next) break;
    nowMs = Math.max(nowMs, next.at);
    if (next.everyMs) next.at = nowMs + next.everyMs;
    else timers = timers.filter(one => one !== next);
    next.act();
    await settle();
  }
  nowMs = end;
}

// ---- the network
const texts = JSON.parse(fs.readFileSync(source + "/protocols/texts/usual_texts.en.json", "utf8")).participant;
const german = JSON.parse(fs.readFileSync(source + "/protocols/texts/usual_texts.de.json", "utf8")).participant;
const net = {isThere: true, isIn: true, words: {name: "one", language: "en", texts}, number: 1, instruction: null, sent: [],
             status: 204, next: null, foreign: () => null};
const loginPage = {type: "text/html", text: "<html>Log in.</html>"};
function replyTo(path, options) {
  if (path === "/words") return [200, net.words];
  if (path === "/now" && !net.isIn) return [401, {why: net.words.texts.code_text, words: net.words.name}];
  if (path === "/now") return [200, {number: net.number, words: net.words.name, instruction: net.instruction}];
  net.sent.push(Object.assign({path}, JSON.parse(options.body)));
  if (net.status === 204 && net.next) show(net.next);
  return [net.status, null];
}
function fetchInTest(path, options) {
  assert.strictEqual(options.credentials, "same-origin");  // browsers of 2018 send no cookie otherwise
  if (!net.isThere) return Promise.reject(new TypeError("no network"));
  const other = net.foreign(path);  // what stands between the page and the app answers in its place
  if (other) return Promise.resolve({status: other.status, headers: {get: () => other.type}, text: async () => other.text});
  const [status, json] = replyTo(path, options);
  const headers = {get: () => json ? "application/json" : null};
  return Promise.resolve({status, headers, text: async () => json ? JSON.stringify(json) : ""});
}

// ---- the page
const page = new Element("main"), bar = new Element("p"), root = new Element("html");
const document = {getElementById: id => id === "page" ? page : bar, createElement: tag => new Element(tag),
                  createElementNS: (space, tag) => new Element(tag), addEventListener() {}, documentElement: root};
const stop = id => { timers = timers.filter(one => one.id !== id); };
const world = {document, fetch: fetchInTest, performance: {now: () => nowMs}, AbortController,
               setTimeout: (act, ms) => addTimer(act, ms, 0), setInterval: (act, ms) => addTimer(act, ms, ms),
               clearTimeout: stop, clearInterval: stop};
world.window = {scrollTo() {}, PointerEvent: function () {}};

function show(instruction) { net.instruction = instruction; ++net.number; net.next = null; }
const consent = {task: "consent", title: "Consent", lines: [], statement: "I take part."};
const facts = {task: "facts", title: "About you", lines: [], questions: ["age"]};
const line = {min: 0, max: 100, step: 1, sections: 10, labels: [], low: "0", high: "10", tap: "Tap 5.", say: "", count: "",
              asked: 50};
const scale = {task: "scale", title: "The scale", lines: [], scale: line};

async function open(instruction) {
  page.append(new Element("p"));  // the sentence for browsers without scripts
  net.instruction = instruction;
  vm.runInNewContext(fs.readFileSync(source + "/study/participant/page/page.js", "utf8"), world);
  await wait(2000);
}
function buttonWith(text) {
  const found = page.querySelectorAll("button").find(one => one.textContent === text);
  assert(found, "no button \"" + text + "\" on: " + page.textContent);
  return found;
}
// A disabled button takes no tap.
function tap(text) {
  const one = buttonWith(text);
  if (!one.disabled && one.listeners.click) one.listeners.click({});
}
function submit() {
  page.querySelector("form").listeners.submit({preventDefault() {}});
}
function says(text) { return page.textContent.includes(text); }

const scenarios = {
  async aDisagreementIsThankedForOnlyAfterItWasSent() {
    await open(consent);
    net.isThere = false;
    tap(texts.decline);
    await wait(300);
    assert(says("I take part.") && says(texts.not_sent) && !says(texts.declined_text));
    net.isThere = true;
    tap(texts.decline);
    await wait(300);
    assert(says(texts.declined_text) && !says(texts.not_sent));
    assert.deepStrictEqual(net.sent, [{path: "/act", number: 1, agrees: false}]);
  },
  async aRefusedAnswerIsNamedAndStays() {
    await open(facts);
    net.status = 400;
    page.querySelector("input").value = " 31 ";
    submit();
    await wait(100);
    assert(says(texts.not_taken));
    assert.strictEqual(page.querySelector("input").value, " 31 ");
    assert.deepStrictEqual(net.sent[0].facts, ["31"]);
    net.status = 204;
    submit();
    await wait(100);
    assert(!says(texts.not_taken));
    assert.strictEqual(net.sent.length, 2);
  },
  async aSecondTapDoesNotSendTheNextPage() {
    await open(consent);
    net.next = facts;
    tap(texts.agree);
    await wait(115);
    assert(says("age"));
    for (let taps = 0; taps < 6; ++taps) {
      tap(texts.send);
      submit();
      await wait(100);
    }
    assert.strictEqual(net.sent.length, 1);
    assert(buttonWith(texts.send).disabled);
    await wait(200);
    assert(!buttonWith(texts.send).disabled);
    submit();
    await wait(10);
    assert.strictEqual(net.sent.length, 2);
  },
  async aSlowReplyHoldsOnlyItsOwnPage() {
    await open(consent);
    const answered = world.fetch;
    world.fetch = (path, options) => path === "/act" ? new Promise(() => {}) : answered(path, options);
    tap(texts.agree);
    await wait(100);
    show(facts);
    await wait(2000);
    assert(says("age") && !buttonWith(texts.send).disabled);
    await wait(5000);
    assert(!says(texts.not_sent) && !buttonWith(texts.send).disabled);
  },
  async theLoginPageOfANetworkIsNoConnection() {
    const answers = [Object.assign({status: 200}, loginPage), Object.assign({status: 401}, loginPage),
                     Object.assign({status: 511}, loginPage), {status: 502, type: null, text: ""},
                     {status: 200, type: "application/json", text: "{\"login\": true}"},
                     {status: 200, type: "application/json", text: "null"}];
    net.foreign = () => answers[0];
    await open(consent);
    assert(!bar.hidden && bar.textContent === "There is no connection.", bar.textContent);
    for (const answer of answers) {
      net.foreign = () => null;
      await wait(1000);
      assert(bar.hidden && says("I take part."), bar.textContent);
      net.foreign = () => answer;
      await wait(1000);
      assert(!bar.hidden && bar.textContent === texts.no_connection, answer.status + ": " + bar.textContent);
      assert(says("I take part."));
      net.foreign = path => path === "/words" ? answer : null;
      net.words = Object.assign({}, net.words, {name: net.words.name + "+"});
      await wait(1000);
      assert(!bar.hidden && bar.textContent === texts.no_connection, answer.status + " for words: " + bar.textContent);
    }
  },
  async aCodeThatTheLoginPageTookIsNotCalledWrong() {
    net.isIn = false;
    await open(consent);
    for (const status of [200, 403]) {
      net.foreign = () => Object.assign({status}, loginPage);
      page.querySelector("input").value = "482913";
      submit();
      await wait(50);
      assert(!says(texts.code_wrong), page.textContent);
      assert(!bar.hidden && bar.textContent === texts.no_connection, bar.textContent);
      assert.strictEqual(page.querySelector("input").value, "482913");
      net.foreign = () => null;
      await wait(1000);
      assert(bar.hidden);
    }
    net.status = 400;
    submit();
    await wait(50);
    assert(says(texts.code_wrong) && bar.hidden);
  },
  async theWordsFollowTheStudy() {
    await open(consent);
    assert.strictEqual(root.lang, "en");
    net.words = {name: "two", language: "de", texts: german};
    await wait(1000);
    assert.strictEqual(root.lang, "de");
    buttonWith(german.agree);
    net.isIn = false;
    await wait(1000);
    assert(says(german.code_title));
    net.words = {name: "one", language: "en", texts};
    await wait(1000);
    assert(says(texts.code_title));
  },
  async digitsOfOtherKeyboardsAreDigits() {
    net.isIn = false;
    await open(consent);
    for (const typed of ["٤٨٢ ٩١٣", "۴۸۲۹۱۳", "４８２　９１３", "४८२९१३", "\u200f482913\u200e"]) {
      page.querySelector("input").value = typed;
      submit();
      await wait(50);
    }
    for (const sent of net.sent) assert.strictEqual(sent.code, "482913");
    assert.strictEqual(net.sent.length, 5);
  },
  async aBrowserWithoutACallIsNamedTooOld() {
    document.createElementNS = undefined;
    await open(scale);
    assert(!bar.hidden && bar.textContent === texts.too_old, bar.textContent);
    show(facts);
    await wait(1000);
    assert(bar.hidden && says("age"));
    net.isThere = false;
    await wait(1000);
    assert(bar.textContent === texts.no_connection, bar.textContent);
  },
  async aBrowserOf2018ShowsEveryPage() {
    delete world.AbortController;
    delete world.window.PointerEvent;
    await open(scale);
    page.querySelector(".tap").listeners.click({clientX: 50});
    tap(texts.send);
    await wait(100);
    assert.deepStrictEqual(net.sent, [{path: "/act", number: 1, tapped: 50}]);
    show({task: "read", title: "Break", lines: ["Rest."], break_seconds: 61, break_clock: "It has lasted {time}"});
    await wait(1000);
    assert(says("It has lasted 1:0") && bar.hidden);
  },
};

if (!scenario) {
  console.log(Object.keys(scenarios).join("\n"));
} else {
  scenarios[scenario]().catch(fault => {
    console.error(fault.message);
    process.exitCode = 1;
  });
}

// SPDX-License-Identifier: Apache-2.0
// The page of `hogel view`. It requests pictures from the server and draws them.
import {View, byWaves, command, hash, methods, query} from "./view.js";
import {Drop} from "./drop.js";
import {InsideLook} from "./inside.js";
import {SceneControls} from "./scene.js";
import {histogram} from "./levels.js";
import {plot} from "./finder.js";
import {Link} from "./link.js";
import {mark} from "./marks.js";
import {Stage} from "./stage.js";
import {keys, listen} from "./keys.js";

const by = id => document.getElementById(id);
const inMotion = {samples: 4, pixels: 512, quality: 80}, atRest = {samples: 16, quality: 93}, speckled = 98;  // JPEG quality of speckled pictures
const pause = 140;  // milliseconds without a change until at rest

const view = new View();
const nothing = {center_u: 0, center_v: 0, tan_half_u: 0.1, tan_half_v: 0.1, ready: false};
let field = nothing;  // the server's last state
let lost = false, number = 0, wanted = 0, drawn = null, resting = 0, hovering = 0;
const asked = new Map();  // request number → time of the change, and the picture's method
let refused = false;  // whether the displayed problem concerns a picture

// Requests

function words(moving) {
  const pixels = moving ? Math.min(stage.pixels, inMotion.pixels) : stage.pixels, how = moving ? inMotion : atRest;
  const columns = view.pair ? Math.max(1, pixels >> 1) : pixels, rows = Math.max(1, Math.round(pixels * stage.aspect));
  return {...view.words(), resolution: `${columns}x${rows}`, "pupil-samples": how.samples};
}

function ask(moving, since) {
  if (!field.ready) return;
  const id = ++number;
  asked.set(id, {since, aspect: stage.aspect, pair: view.pair, by: view.by});
  for (const old of asked.keys()) if (old < id - 64) asked.delete(old);
  const waves = byWaves(view.by), looks = moving && waves ? {looks: 1, preview: "yes"} : {};
  if (waves && !(drawn && byWaves(drawn.by))) announceWaves();
  link.send("picture?" + query({...words(moving), ...looks, quality: moving ? inMotion.quality : waves ? speckled : atRest.quality, moving: moving ? "yes" : "no", id}));
}

// Fetches a path from the server, with the token if there is one.
async function get(path, words) {
  const token = new URLSearchParams(location.search).get("token");
  const answer = await fetch(path + query({...words, ...(token ? {token} : {})}));
  if (!answer.ok) throw new Error((await answer.json()).message);
  return answer;
}

// The view has changed: requests a coarse picture with the next animation frame, a fine one at rest.
function changed() {
  show();
  if (!wanted) {
    const since = performance.now();
    wanted = requestAnimationFrame(() => { wanted = 0; ask(true, since); });
  }
  clearTimeout(resting);
  resting = setTimeout(rest, pause);
}

function rest() {
  // On a slow screen the animation frame of the last change may be pending; its picture would replace the fine one.
  cancelAnimationFrame(wanted);
  wanted = 0;
  ask(false, performance.now());
  inside.look();
  remember();
}

// Stores the view and the changed options in the address.
const address = () => location.pathname + location.search + hash({...view.words(), ...scene.words, ...layerWords()});
const remember = () => history.replaceState(null, "", address());

async function picture(about, blob) {
  const id = Number(about.id), {since, aspect = stage.shown, pair = view.pair, by: method = view.by} = asked.get(id) ?? {};
  if (!(await stage.draw(blob, id, aspect))) return;
  drawn = {...about, pair, by: method};
  if (refused) problem("");
  if (method === view.by) wavesAnnounced();
  if (about.looks === about.of_looks) asked.delete(id);
  const latency = since === undefined ? 0 : performance.now() - since;
  const how = about.looks ? `look ${about.looks} of ${about.of_looks}, ${about.seconds.toFixed(1)} s` : `${about.pupil_samples} points of the pupil, ${Math.round(latency)} ms`;
  by("timing").textContent = `${about.width} × ${about.height}, ${how}${about.psnr ? `, ${about.psnr.toFixed(1)} dB apart` : ""}`;
  stage.canvas.dispatchEvent(new CustomEvent("hogel-picture", {detail: {...about, latency}}));
}

// A picture was refused: keeps the displayed one and its method.
function refuse(message) {
  if (asked.get(Number(message.id))?.by !== view.by) return;  // superseded by another method
  const before = drawn?.by ?? (field.rays === false ? "waves" : "rays");
  problem(message.message, message.parameter);
  refused = true;
  if (view.by === before) return;
  view.by = before;
  show();
  remember();
  if (!drawn) ask(false, performance.now());
}

// Texts of the page

const millimetres = value => `${+value.toFixed(Math.abs(value) < 10 ? 2 : 1)} mm`;

function show() {
  const aspect = field.ready ? field.height_m / field.width_m / (view.pair ? 2 : 1) : 1;
  if (aspect !== stage.aspect) {
    stage.aspect = aspect;
    if (!drawn) stage.shown = aspect;
    stage.fit();
  }
  const stops = view.exposure === null || !field.exposure ? 0 : Math.log2(view.exposure / field.exposure);
  const reach = focusReach();
  by("distance").value = Math.log10(view.eye[2] / 300);
  by("distance-out").textContent = millimetres(view.eye[2]);
  by("focus").min = -Math.min(reach, 0.9 * view.eye[2]);
  by("focus").max = reach;
  by("focus").value = view.focus;
  by("focus-out").textContent = millimetres(view.focus);
  by("pupil").value = Math.log10(view.pupil);
  by("pupil-out").textContent = millimetres(view.pupil);
  by("stops").value = stops;
  by("stops-out").textContent = view.exposure === null ? "automatic" : `${stops > 0 ? "+" : ""}${stops.toFixed(1)} stops`;
  by("display").value = view.display;
  by("by").value = view.by;
  by("stereo").checked = view.eyes > 0;
  by("stereo").disabled = view.two;
  by("eye").textContent = view.eye.map(value => value.toFixed(1)).join(", ") + " mm";
  for (const id of ["distance", "focus", "pupil", "stops"]) by(id).setAttribute("aria-valuetext", by(`${id}-out`).textContent);
}

// Range of the focus slider: a multiple of the depth that the light field resolves, at least the current focus.
function focusReach() {
  const resolved = field.hogels_s ? 6e3 * field.width_m / field.hogels_s / (2 * field.tan_half_u / field.directions_u) : field.pitch_m ? 1e3 * reachOfSamples() : 20;
  return Math.max(1, +resolved.toPrecision(2), Math.abs(view.focus));
}

// Depth at which sample pitch and aperture limit the resolution of a hologram equally, metres.
const reachOfSamples = () => Math.max(field.samples_x, field.samples_y) * field.pitch_m ** 2 / field.wavelengths_m[0];

let saidUntil = 0;
function say(text) {
  by("said").textContent = text;
  clearTimeout(saidUntil);
  saidUntil = setTimeout(() => { by("said").textContent = ""; }, 4000);
}

// The first picture by waves may take long: shows a note, unless the waves are ready.
let announcing = 0;
function announceWaves() {
  if (announcing) return;
  announcing = setTimeout(() => { clearTimeout(saidUntil); by("said").textContent = drawn ? "Computing waves; until then by rays" : "Computing waves"; }, 300);
}

function wavesAnnounced() {
  if (!announcing) return;
  clearTimeout(announcing);
  announcing = 0;
  say("");
}

// parameters: names of the parameters of the problem
function problem(text, parameters = []) {
  refused = false;
  if (text) wavesAnnounced();
  if (text) say("");
  by("problem").hidden = !text;
  by("problem-text").textContent = text;
  mark(parameters, text);
}

function state(message) {
  const first = message.ready && (!field.ready || message.opened !== field.opened), another = message.generation !== field.generation;
  // A link applies to the file opened with the page; other files start with the front view.
  const linked = !field.ready;
  field = {...nothing, ...message};
  by("name").textContent = field.name.split("/").filter(Boolean).at(-1) ?? "hogel view";
  by("name").title = field.name;
  document.title = `${by("name").textContent} – hogel view`;
  by("cover").hidden = !field.work;
  by("cover-text").textContent = field.work ? `${field.work[0].toUpperCase()}${field.work.slice(1)}, ${Math.round(100 * field.fraction)} %` : "";
  by("bar").value = field.fraction;
  if (!field.ready) return;
  by("facts").textContent = facts();
  const known = offered();
  for (const option of by("by").options) option.hidden = option.disabled = !known.includes(option.value);
  by("by-control").hidden = known.length < 2;
  by("finder").hidden = by("levels").hidden = field.kind !== "hologram";
  if (field.encodings && by("encoding").options.length === 0) by("encoding").append(...field.encodings.map(name => new Option(name, name)));
  inside.offer(field);
  if (first) {
    view.reset(field);
    if (linked) view.read(location.hash); else forget();
  }
  scene.show(field.scene, field.width_m, field.height_m);
  showLayers();
  show();
  if (first && linked) {
    scene.read(location.hash);
    readLayers();
  }
  if (another) problem("");
  if (first || another) {
    ask(false, performance.now());
    inside.look();
  }
}

// Available methods.
const offered = () => methods.filter(method => byWaves(method) ? field.looks > 0 && (field.rays || method === "waves") : field.rays && (method === "rays" || field.has_original));

// Another file starts without the changed options.
function forget() {
  scene.words = {};
  layers = 0;
  by("finder-plot").replaceChildren();
  by("levels-plot").replaceChildren();
  problem("");
  say("");
  remember();
}

// Layers of a compressed light field

let layers = 0;  // 0: all
const layerWords = () => layers ? {layers: String(layers)} : {};

function setLayers(count) {
  layers = count === field.stream?.of_layers ? 0 : count;
  link.send("change?" + query({layers: layers ? String(layers) : ""}));
  remember();
}

function readLayers() {
  const wanted = Number(new URLSearchParams(location.hash.replace(/^#/, "")).get("layers"));
  if (field.stream && Number.isInteger(wanted) && wanted > 0 && wanted < field.stream.of_layers) setLayers(wanted);
}

function showLayers() {
  const {stream} = field;
  by("layers-control").hidden = !stream;
  if (!stream) return;
  by("layers").max = stream.of_layers;
  by("layers").disabled = stream.of_layers < 2;
  if (document.activeElement !== by("layers") || !field.work) by("layers").value = stream.layers;
  by("layers-out").textContent = `${stream.layers} of ${stream.of_layers}`;
  by("layers").setAttribute("aria-valuetext", by("layers-out").textContent);
  const beside = stream.original ? `beside ${stream.original}` : "beside the whole file";
  const errors = stream.exact ? `no error ${beside}` : stream.sqnr_db === undefined ? "its error is being measured" : `SQNR ${stream.sqnr_db.toFixed(1)} dB ${beside}`;
  by("layers-hint").textContent = `${size(stream.bytes)}, ${errors}.`;
}

// Prevents line breaks at hyphens.
const showCommand = (place, command) => place.replaceChildren(...command.split(" ").flatMap((word, i) => [i ? " " : "", Object.assign(document.createElement("span"), {textContent: word})]));

const size = bytes => bytes < 1e6 ? `${(bytes / 1e3).toPrecision(3)} kB` : `${(bytes / 1e6).toPrecision(3)} MB`;

function facts() {
  if (field.kind === "hologram")
    return `${field.samples_x} × ${field.samples_y} samples of ${+(1e6 * field.pitch_m).toPrecision(4)} µm, ${field.wavelengths_m.map(each => Math.round(1e9 * each)).join(", ")} nm, ` +
      `efficiency ${(100 * field.efficiency).toPrecision(2)} %`;
  const coarse = field.shown_hogels_s < field.hogels_s ? `, shown by ${field.shown_hogels_s} across` : "";
  return `${field.hogels_s} × ${field.hogels_t} hogels of ${field.directions_u} × ${field.directions_v} directions${coarse}`;
}

function reading(message) {
  const side = (value, positive, negative) => `${Math.abs(value).toFixed(2)}° ${value < 0 ? negative : positive}`;
  const parts = [`x ${millimetres(1e3 * message.x_m)}, y ${millimetres(1e3 * message.y_m)} on the hologram`,
                 `${side(message.across_deg, "right", "left")}, ${side(message.up_deg, "up", "down")}`];
  if (!message.inside) parts.push(`outside the ${field.kind}`);
  if (message.radiance) parts.push(`${field.kind === "hologram" ? "intensity" : "radiance"} ${message.radiance.map(value => +value.toPrecision(3)).join(" ")}`);
  if (message.depth_m !== undefined) parts.push(`depth ${millimetres(1e3 * message.depth_m)}`);
  if (message.hogel_bytes !== undefined) parts.push(`hogel ${Math.round(message.hogel_bytes)} bytes`);
  if (message.phase_deg !== undefined) parts.push(`phase ${message.phase_deg.toFixed(0)}°`);
  by("reading").textContent = parts.join(" · ");
}

// Actions

const to = {
  move(right, up) {
    if (scene.dragging !== "eye") return scene.drag(right, up);
    const z = view.eye[2];
    view.moveTo(view.eye[0] + right * 2 * field.tan_half_u * z, view.eye[1] + up * 2 * field.tan_half_v * z, field);
    changed();
  },
  zoom(factor) { view.moveAway(factor); changed(); },
  step(what, direction) {
    if (what === "focus") view.focus = Math.max(view.focus + direction * focusReach() / 60, -0.9 * view.eye[2]);
    if (what === "pupil") view.pupil = Math.min(Math.max(view.pupil * 10 ** (direction * 0.05), 0.1), 100);
    if (what === "stops") view.exposure = (view.exposure ?? field.exposure) * 2 ** (direction / 3);
    changed();
  },
  stereo() { if (!view.two) { view.eyes = view.eyes > 0 ? 0 : 63; changed(); } },
  by(method) {
    if (!offered().includes(method)) return;
    view.by = method;
    if (view.two) view.eyes = 0;
    changed();
  },
  method() { const known = offered(); to.by(known[(known.indexOf(view.by) + 1) % known.length]); },
  inside() { inside.next(); },
  async find() {
    if (field.kind !== "hologram") return say("The depths of a light field are found by a click on the picture");
    say("Looking for planes in focus");
    try {
      by("finder-plot").replaceChildren(...plot(await (await get("/sharpness?", {by: "waves"})).json(), depth => { view.focus = Math.max(depth, -0.9 * view.eye[2]); changed(); }));
      say("");
    } catch (error) { say(error.message); }
  },
  async levels() {
    if (field.kind !== "hologram") return say("A light field has no levels of a modulator");
    say("Counting levels");
    try {
      by("levels-plot").replaceChildren(...histogram(await (await get("/levels?", {encoding: by("encoding").value})).json()));
      say("");
    } catch (error) { say(error.message); }
  },
  dragging() {
    if (!field.scene) return say("A file stays as it is; only scenes move");
    scene.dragging = {eye: "scene", scene: "light", light: "eye"}[scene.dragging];
    say(`Dragging and arrow keys move the ${scene.dragging}`);
  },
  make() {
    if (!field.scene) return say("Scenes are made; this is a file");
    showCommand(by("made-command"), field.scene.make);
    by("made").showModal();
  },
  open() { by("file").click(); },
  tone() { view.display = view.display === "log" ? "intensity" : "log"; changed(); },
  focusAt(x, y) { link.send("focus?" + query({...words(false), x: inAsked(x).toFixed(5), y: y.toFixed(5)})); },
  focusMiddle() { to.focusAt(0.5, 0.5); },
  reset() { view.reset(field); changed(); },
  async save(format = "png") {
    try {
      const answer = await get("/picture?", {...words(false), format}), name = `view.${format}`;
      const link = Object.assign(document.createElement("a"), {href: URL.createObjectURL(await answer.blob()), download: name});
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
      say(`Saved ${name}`);
    } catch (error) { say(`Not saved: ${error.message}`); }
  },
  copyCommand() {
    const all = words(false);
    if (drawn && all.display !== "log") all.exposure = String(+drawn.exposure.toPrecision(9));
    copy(command(field.photo ?? "hogel photo LIGHTFIELD", all, view, field));
  },
  copyLink() { copy(location.origin + address()); },
  full() { document.fullscreenElement ? document.exitFullscreen() : by("stage").requestFullscreen?.(); },
  help() { by("keys").showModal(); by("keys").scrollTop = 0; },
};

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    say(`Copied: ${text}`);
  } catch { window.prompt("Copy:", text); }
}

// Converts a horizontal position in the drawn picture to one in the requested picture.
const inAsked = x => !drawn || drawn.pair === view.pair ? x : view.pair ? x / 2 : 2 * x % 1;

const stage = new Stage(by("picture"), {
  drag: (dx, dy) => scene.dragging === "eye" ? to.move(-dx, dy) : scene.drag(dx, -dy),
  zoom: to.zoom,
  click: to.focusAt,
  hover(x, y) {
    inside.point(x, y);
    if (hovering || !field.ready) return;
    hovering = setTimeout(() => { hovering = 0; }, 100);
    link.send("reading?" + query({...words(false), x: inAsked(Math.min(Math.max(x, 0), 1)).toFixed(5), y: Math.min(Math.max(y, 0), 1).toFixed(5)}));
  },
});
stage.fit();

const inside = new InsideLook(by, async there => (await get("/inside?", {...words(false), ...there})).blob());

const scene = new SceneControls(by, (words, moving) => {
  link.send("change?" + query({...words, ...(moving ? {moving: "yes"} : {})}));
  if (!moving) remember();
}, 250);

new Drop(by, {
  maxBytes: () => field.max_file_bytes ?? 0,
  address(name, more) {
    const token = new URLSearchParams(location.search).get("token");
    return "/drop?" + query({name, ...(more ? {more: "yes"} : {}), ...(token ? {token} : {})});
  },
  began: say, ended: say, failed: problem,
});

const link = new Link({
  onOpen() { if (lost) problem(""); lost = false; if (field.ready) ask(false, performance.now()); },
  onLost() { lost = true; problem("The server does not answer: hogel view has ended, or this page's address is of an earlier one. Trying again."); },
  onPicture: picture,
  onText(message) {
    if (message.type === "state") state(message);
    if (message.type === "reading") reading(message);
    if (message.type === "focus") { view.focus = 1e3 * message.depth_m; changed(); say(`In focus: ${millimetres(view.focus)}`); }
    if (message.type === "problem") problem(message.message, message.parameter);
    if (message.type === "error") message.id ? refuse(message) : say(message.message);
  },
});

by("distance").addEventListener("input", event => to.zoom(300 * 10 ** event.target.value / view.eye[2]));
by("focus").addEventListener("input", event => { view.focus = Number(event.target.value); changed(); });
by("pupil").addEventListener("input", event => { view.pupil = 10 ** event.target.value; changed(); });
by("stops").addEventListener("input", event => {
  const stops = Number(event.target.value);
  view.exposure = stops === 0 ? null : field.exposure * 2 ** stops;
  changed();
});
by("display").addEventListener("change", event => { view.display = event.target.value; changed(); });
by("by").addEventListener("change", event => to.by(event.target.value));
by("find").addEventListener("click", to.find);
by("count-levels").addEventListener("click", to.levels);
by("layers").addEventListener("input", event => setLayers(Number(event.target.value)));
by("make").addEventListener("click", to.make);
by("copy-made").addEventListener("click", () => copy(by("made-command").textContent));
by("dismiss").addEventListener("click", () => problem(""));
by("stereo").addEventListener("change", to.stereo);
by("controls").addEventListener("change", event => { if (event.target.matches("[aria-invalid]")) problem(""); });
by("controls").addEventListener("reset", event => { event.preventDefault(); to.reset(); });
by("controls").addEventListener("submit", event => event.preventDefault());
for (const [id, act] of Object.entries({save: () => to.save(), "save-exr": () => to.save("exr"), "copy-command": to.copyCommand, "copy-link": to.copyLink, full: to.full, help: to.help}))
  by(id).addEventListener("click", act);

const themes = ["system", "light", "dark"];
by("theme").addEventListener("click", () => {
  const root = document.documentElement, next = themes[(themes.indexOf(root.dataset.theme ?? "system") + 1) % themes.length];
  if (next === "system") delete root.dataset.theme; else root.dataset.theme = next;
  by("theme").textContent = `Theme: ${next}`;
});

const table = keys(to);
listen(table);
by("key-rows").append(...table.map(row => {
  const line = document.createElement("tr"), key = line.insertCell(), text = line.insertCell();
  for (const each of row.shown.split(" ")) key.append(Object.assign(document.createElement("kbd"), {textContent: each}), " ");
  text.textContent = row.text;
  return line;
}));

window.addEventListener("hashchange", () => { view.read(location.hash); scene.read(location.hash); readLayers(); changed(); });
new ResizeObserver(() => { const before = stage.pixels; if (stage.fit() !== before && field.ready) changed(); }).observe(by("stage"));
show();

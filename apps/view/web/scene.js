// SPDX-License-Identifier: Apache-2.0
// Live scene: rotation, light, position and sampling, as options of hogel. The server renders.

const degrees = Math.PI / 180;
const tidy = number => String(+number.toFixed(3));
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

// Converts rotations about x, then y, then z to matrices and back.
function matrix([a, b, c]) {
  const [sa, ca, sb, cb, sc, cc] = [a, b, c].flatMap(angle => [Math.sin(angle * degrees), Math.cos(angle * degrees)]);
  return [[cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa], [sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa], [-sb, cb * sa, cb * ca]];
}
const angles = m => [Math.atan2(m[2][1], m[2][2]), Math.atan2(-m[2][0], Math.hypot(m[2][1], m[2][2])), Math.atan2(m[1][0], m[0][0])].map(angle => angle / degrees);
const times = (a, b) => a.map(row => b[0].map((_, j) => row.reduce((sum, value, k) => sum + value * b[k][j], 0)));

const usualStrength = 2.2;  // default strength of a light on the command line

// Sliders: value from the server's state, and the option that they set. `log`: logarithmic scale.
const sliders = [
  {id: "turn", of: scene => scene.rotate_deg[1], unit: "°", word: (scene, value) => rotate(scene, 1, value)},
  {id: "tilt", of: scene => scene.rotate_deg[0], unit: "°", word: (scene, value) => rotate(scene, 0, value)},
  {id: "roll", of: scene => scene.rotate_deg[2], unit: "°", word: (scene, value) => rotate(scene, 2, value)},
  {id: "hogels", log: true, whole: true, of: scene => scene.hogels[0], unit: "", word: (scene, value) => ({hogels: counts(scene.hogels, value)})},
  {id: "directions", log: true, whole: true, of: scene => scene.directions[0], unit: "", word: (scene, value) => ({directions: counts(scene.directions, value)})},
  {id: "size", log: true, of: scene => 1e3 * scene.size_m, unit: " mm", word: (_, value) => ({size: `${tidy(value)}mm`})},
  {id: "fov", log: true, of: scene => scene.fov_deg[0], unit: "°", word: (scene, value) => ({fov: `${tidy(value)},${tidy(Math.min(value * scene.fov_deg[1] / scene.fov_deg[0], 170))}deg`})},
  {id: "front", of: scene => scene.front, unit: "", word: (_, value) => ({front: tidy(value)})},
  {id: "nearer", of: scene => 1e3 * scene.move_m[2], unit: " mm", word: (scene, value) => ({move: `${tidy(1e3 * scene.move_m[0])},${tidy(1e3 * scene.move_m[1])},${tidy(value)}mm`})},
  {id: "pitch", log: true, of: scene => 1e6 * scene.pitch_m, unit: " µm", word: (_, value) => ({pitch: `${tidy(value)}um`})},
  {id: "light-across", of: scene => lightOf(scene)[0], unit: "°", word: (scene, value) => light(value, lightOf(scene)[1], lightOf(scene)[2])},
  {id: "light-up", of: scene => lightOf(scene)[1], unit: "°", word: (scene, value) => light(lightOf(scene)[0], value, lightOf(scene)[2])},
  {id: "light-strength", of: scene => lightOf(scene)[2], unit: "", word: (scene, value) => light(lightOf(scene)[0], lightOf(scene)[1], value)},
];

const counts = ([columns, rows], value) => columns === rows ? String(value) : `${value}x${Math.max(1, Math.round(value * rows / columns))}`;
const rotate = (scene, axis, value) => ({rotate: scene.rotate_deg.map((angle, i) => tidy(i === axis ? value : angle)).join(",") + "deg"});

// White light from a direction in degrees to the right of and above the viewer.
function light(across, up, strength) {
  const cosine = Math.cos(up * degrees);
  return {light: [Math.sin(across * degrees) * cosine, Math.sin(up * degrees), Math.cos(across * degrees) * cosine].map(tidy).join(",") + `:white:${tidy(strength)}`};
}

function lightOf(scene) {
  const [from, , strength] = (scene.lights[0] ?? "").split(":"), [x, y, z] = (from || "-0.45,0.55,0.7").split(",").map(Number);
  return [Math.atan2(x, z) / degrees, Math.atan2(y, Math.hypot(x, z)) / degrees, strength === undefined ? usualStrength : Number(strength)];
}

export class SceneControls {
  // send(words, moving) requests a change; pause: milliseconds without a change until at rest.
  constructor(by, send, pause) {
    Object.assign(this, {by, send, pause, scene: null, first: null, words: {}, waiting: {}, going: false, resting: 0});
    for (const slider of sliders)
      by(slider.id).addEventListener("input", event => this.set(slider.word(this.scene, this.value(slider, Number(event.target.value)))));
    for (const button of document.querySelectorAll("[data-enough]"))
      button.addEventListener("click", () => this.take(button.dataset.enough));
    by("own-lights").addEventListener("click", () => this.set({light: ""}));
    by("as-given").addEventListener("click", () => this.set(Object.fromEntries(Object.keys(this.words).map(name => [name, ""]))));
  }

  get dragging() { return document.querySelector("input[name=dragging]:checked")?.value ?? "eye"; }
  set dragging(what) { for (const each of document.querySelectorAll("input[name=dragging]")) each.checked = each.value === what; }

  value(slider, position) {
    const value = slider.log ? 10 ** position : position;
    return slider.whole ? Math.round(value) : value;
  }

  // Changes options: coarse in motion, then fine. While a change is in progress, only the newest one waits.
  set(words) {
    if (!this.scene) return;
    for (const [name, value] of Object.entries(words)) if (value) this.words[name] = value; else delete this.words[name];
    Object.assign(this.waiting, words);
    this.next();
    clearTimeout(this.resting);
    this.resting = setTimeout(() => { this.send({...this.unsettled, ...this.waiting}, false); this.waiting = {}; this.unsettled = {}; this.going = false; }, this.pause);
  }

  next() {
    if (this.going || !Object.keys(this.waiting).length) return;
    this.going = true;
    clearTimeout(this.late);
    this.late = setTimeout(() => { this.going = false; }, 2000);  // the change was refused
    this.send(this.waiting, true);
    this.unsettled = {...this.unsettled, ...this.waiting};
    this.waiting = {};
  }

  // Applies the options of a link, and only those.
  read(hash) {
    const words = new URLSearchParams(hash.replace(/^#/, ""));
    const wanted = {};
    for (const name of ["hogels", "directions", "size", "fov", "front", "move", "rotate", "light", "pitch"])
      if (words.get(name)) wanted[name] = words.get(name);
    const changed = {};
    for (const name of new Set([...Object.keys(wanted), ...Object.keys(this.words)])) if (wanted[name] !== this.words[name]) changed[name] = wanted[name] ?? "";
    this.words = wanted;
    if (this.scene && Object.keys(changed).length) this.send(changed, false);
  }

  // Rotates the scene about the viewer's axes, or moves the light, by a drag in fractions of the picture.
  drag(right, up) {
    if (!this.scene) return;
    if (this.dragging === "light") {
      const [across, above, strength] = lightOf(this.scene);
      const moved = light(clamp(across + 180 * right, -180, 180), clamp(above + 180 * up, -90, 90), strength);
      this.scene.lights = [moved.light];  // accumulates drags until the server answers
      return this.set(moved);
    }
    this.scene.rotate_deg = angles(times(matrix([-180 * up, 180 * right, 0]), matrix(this.scene.rotate_deg)));
    this.set({rotate: this.scene.rotate_deg.map(tidy).join(",") + "deg"});
  }

  // Sets a parameter to the advised number.
  take(option) {
    const advice = this.scene?.advice.find(each => each.option === option);
    const slider = sliders.find(each => each.id === option);
    if (advice) this.set(slider.word(this.scene, option === "pitch" ? 1e6 * advice.enough : advice.enough));
  }

  show(scene, width, height) {
    const {by} = this;
    by("scene").hidden = !scene;
    if (!scene) { this.dragging = "eye"; this.scene = null; return; }
    // Does not move a slider that the user is dragging.
    const held = this.scene && (this.resting && this.going) ? this.scene : null;
    this.scene = {...scene, ...(held ? {rotate_deg: held.rotate_deg, lights: held.lights} : {})};
    this.going = false;
    this.next();
    by("front-control").hidden = !scene.is_file;
    by("nearer-control").hidden = scene.is_file;
    for (const id of ["nearer"]) { by(id).min = -1e3 * width; by(id).max = 1e3 * width; }
    for (const slider of sliders) {
      const value = slider.of(this.scene), input = by(slider.id), position = slider.log ? Math.log10(value) : value;
      if (document.activeElement !== input || !held) input.value = position;
      const text = slider.id.startsWith("light") && !this.scene.lights.length ? "scene's own" : `${slider.unit === "°" ? +value.toFixed(1) : +value.toPrecision(4)}${slider.unit}`;
      by(`${slider.id}-out`).textContent = text;
      input.setAttribute("aria-valuetext", text);
    }
    by("own-lights").hidden = !this.scene.lights.length;
    by("as-given").disabled = !Object.keys(this.words).length;
    for (const option of ["hogels", "directions", "pitch"]) {
      const told = scene.advice.filter(each => each.option === option), advice = told.find(each => each.refused) ?? told[0];
      by(`${option}-advice`).hidden = !advice;
      by(`${option}-advice`).classList.toggle("refused", advice?.refused ?? false);
      by(`${option}-advice-text`).textContent = advice ? `${advice.text[0].toUpperCase()}${advice.text.slice(1).replaceAll(" um", " µm")}.` : "";
      const button = document.querySelector(`[data-enough=${option}]`);
      button.textContent = advice ? `Take ${option === "pitch" ? `${+(1e6 * advice.enough).toPrecision(4)} µm` : advice.enough}` : "";
    }
  }
}

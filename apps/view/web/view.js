// SPDX-License-Identifier: Apache-2.0
// Parameters of the view, shared by the address, requests and command lines. Lengths in millimetres.

const tidy = number => String(+number.toFixed(4));
const clamp = (value, low, high) => Math.min(Math.max(value, low), high);

export const methods = ["rays", "waves", "side", "difference", "original", "error"];
export const byWaves = by => ["waves", "side", "difference"].includes(by);
export const nearest = 20, farthest = 5000;

export class View {
  constructor() { this.reset({center_u: 0, center_v: 0}); }

  reset(field) {
    this.eye = [-300 * field.center_u, -300 * field.center_v, 300];
    this.focus = 0;
    this.pupil = 6;
    this.exposure = null;  // automatic
    this.display = "intensity";
    this.eyes = 0;  // distance of two viewpoints; 0: one viewpoint
    this.by = field.rays === false ? "waves" : "rays";
  }

  // Whether two methods are compared from one viewpoint.
  get two() { return this.by === "side" || this.by === "difference"; }
  // Whether two pictures are side by side.
  get pair() { return this.eyes > 0 || this.by === "side"; }

  // Returns the parameters stored in a link.
  words() {
    const words = {eye: `${this.eye.map(tidy).join(",")}mm`, focus: `${tidy(this.focus)}mm`, pupil: `${tidy(this.pupil)}mm`};
    if (this.exposure !== null) words.exposure = String(+this.exposure.toPrecision(6));
    if (this.display !== "intensity") words.display = this.display;
    if (this.by !== "rays") words.by = this.by;
    if (this.eyes > 0) words.eyes = `${tidy(this.eyes)}mm`;
    return words;
  }

  // Reads the parameters of a link; skips invalid ones.
  read(hash) {
    const words = new URLSearchParams(hash.replace(/^#/, ""));
    const length = text => { const match = /^(-?[\d.]+(?:e-?\d+)?)mm$/.exec(text ?? ""); return match ? Number(match[1]) : NaN; };
    const eye = /^([-\d.e]+),([-\d.e]+),([-\d.e]+)mm$/.exec(words.get("eye") ?? "")?.slice(1).map(Number);
    if (eye && eye.every(Number.isFinite) && eye[2] >= 1) this.eye = eye;
    const focus = length(words.get("focus")), pupil = length(words.get("pupil")), exposure = Number(words.get("exposure") ?? NaN);
    if (Number.isFinite(focus) && focus > -this.eye[2]) this.focus = focus;
    if (pupil > 0) this.pupil = pupil;
    if (exposure > 0 && Number.isFinite(exposure)) this.exposure = exposure;
    const eyes = length(words.get("eyes"));
    this.eyes = eyes > 0 ? eyes : 0;
    if (methods.includes(words.get("by"))) this.by = words.get("by");
    if (this.two) this.eyes = 0;
    if (["intensity", "log"].includes(words.get("display"))) this.display = words.get("display");
  }

  // Restricts the viewpoint to the region that sees the middle of the hologram.
  moveTo(x, y, field) {
    const z = this.eye[2];
    this.eye[0] = clamp(x, (-field.center_u - field.tan_half_u) * z, (-field.center_u + field.tan_half_u) * z);
    this.eye[1] = clamp(y, (-field.center_v - field.tan_half_v) * z, (-field.center_v + field.tan_half_v) * z);
  }

  // Keeps the direction of the viewpoint.
  moveAway(factor) {
    const z = clamp(this.eye[2] * factor, nearest, farthest);
    this.eye = this.eye.map(value => value * z / this.eye[2]);
    this.focus = Math.max(this.focus, -0.9 * this.eye[2]);
  }
}

export const query = words => Object.entries(words).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");
// Commas need no escape in a query and are easier to read.
export const hash = words => "#" + query(words).replaceAll("%2C", ",");
// Returns the command that reproduces a view, two for two viewpoints or methods. `photo`: the server's command without the camera.
export function command(photo, words, view, field) {
  const {eyes, by, "pupil-samples": samples, ...others} = words;
  const how = waves => field.rays === false ? {} : waves ? {wave: "", looks: field.looks} : {geometric: "", "pupil-samples": samples};
  const one = (name, eye, waves) => `${photo} -o ${name} ${Object.entries({...how(waves), ...others, eye}).map(([word, value]) => `--${word} ${value}`).join(" ").replaceAll("  ", " ")}`;
  const photographs = photo.split(" && ").at(-1), original = words => words.replace(photo, field.photo_original ?? photographs);
  if (view.by === "original") return original(one("view.png", words.eye, false));
  if (view.by === "error") return `${one("shown.png", words.eye, false)} && ${original(one("original.png", words.eye, false))} && hogel compare original.png shown.png`;
  const waves = byWaves(view.by);
  if (view.two) return `${one("rays.png", words.eye, false)} && ${one("waves.png", words.eye, true)}`;
  if (!eyes) return one("view.png", words.eye, waves);
  const of = side => `${[view.eye[0] + side * view.eyes / 2, view.eye[1], view.eye[2]].map(tidy).join(",")}mm`;
  return `${one("left.png", of(-1), waves)} && ${one("right.png", of(1), waves)}`;
}

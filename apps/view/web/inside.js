// SPDX-License-Identifier: Apache-2.0
// Small picture of the data under the pointer, computed by the server.

const kinds = {
  "light field": {off: "Off", hogel: "One hogel, all of its directions", views: "Views from 7 × 7 directions", "s-u": "Epipolar plane (s, U)", "t-v": "Epipolar plane (t, V)", depth: "Depth, near is bright", coverage: "Coverage of the hogels", rate: "Bytes of each hogel"},
  hologram: {off: "Off", intensity: "Fringes: intensity", phase: "Fringes: phase", real: "Fringes: real part", spectrum: "Local spectrum, four decades"},
};
const captions = {
  hogel: "Directions to the right and up, of the hogel under the pointer.", views: "Each picture is one direction.",
  "s-u": "s to the right, U down: a point makes a line, whose slope is its depth.", "t-v": "V to the right, t down.",
  depth: "White is nearest, black holds nothing.", coverage: "The share of each hogel's rays that meet something.",
  rate: "What each hogel takes in the file.", intensity: "140 × 140 samples around the pointer.",
  phase: "140 × 140 samples; black is −180°, white 180°.", real: "140 × 140 samples; grey is zero.",
  spectrum: "Frequency zero in the middle, half a cycle a sample at the edges.",
};

const sides = {intensity: 140, phase: 140, real: 140, spectrum: 256};  // samples; each covers at least two screen pixels

export class InsideLook {
  // ask(words): returns a promise of the picture's Blob. One request at a time; the newest point comes next.
  constructor(by, ask) {
    Object.assign(this, {by, ask, at: [0.5, 0.5], going: false, waiting: false, kind: ""});
    by("inside-what").addEventListener("change", () => { this.show(); this.look(); });
    by("inside-large").addEventListener("click", () => { by("large").showModal(); });
  }

  // Sets the available kinds.
  offer(field) {
    this.bytes = field.hogel_bytes;
    const known = Object.entries(kinds[field.kind] ?? {}).filter(([value]) => (value !== "depth" || field.depth) && (value !== "rate" || this.bytes));
    const kind = known.map(([value]) => value).join();
    if (kind === this.kind) return this.show();
    this.kind = kind;
    const what = this.by("inside-what"), before = what.value;
    what.replaceChildren(...known.map(([value, text]) => new Option(text, value)));
    if (known.some(([value]) => value === before)) what.value = before;
    this.show();
  }

  // Selects the next kind, for the keyboard.
  next() {
    const what = this.by("inside-what");
    what.selectedIndex = (what.selectedIndex + 1) % what.options.length;
    this.show();
    this.look();
  }

  get what() { return this.by("inside-what").value; }

  show() {
    const on = this.what !== "off" && this.what !== "";
    this.by("inside-large").hidden = this.by("inside-caption").hidden = !on;
    this.by("inside-caption").textContent = captions[this.what] ?? "";
    const ends = {coverage: ["0 %", "100 %"], rate: this.bytes?.map(bytes => `${Math.round(bytes)} bytes`)}[this.what];
    this.by("legend").hidden = !ends;
    if (ends) [this.by("legend-low").textContent, this.by("legend-high").textContent] = ends;
  }

  point(x, y) {
    this.at = [x, y];
    if (!["views", "depth", "coverage", "rate"].includes(this.what)) this.look();
  }

  async look() {
    if (!this.what || this.what === "off") return;
    if (this.going) { this.waiting = true; return; }
    this.going = true;
    const what = this.what, [x, y] = this.at.map(value => Math.min(Math.max(value, 0), 1).toFixed(5));
    try {
      const url = URL.createObjectURL(await this.ask({what, x, y, side: sides[what] ?? 560}));
      if (this.url) URL.revokeObjectURL(this.url);
      this.url = url;
      for (const id of ["inside-picture", "large-picture"]) {
        this.by(id).src = url;
        this.by(id).alt = `${this.by("inside-what").selectedOptions[0].text}. ${captions[what]}`;
      }
      await this.by("inside-picture").decode();
      this.by("inside-picture").dispatchEvent(new CustomEvent("hogel-inside", {detail: {what, x, y}}));
    } catch (error) { this.by("inside-caption").textContent = error.message; }
    this.going = false;
    if (this.waiting) { this.waiting = false; this.look(); }
  }
}

// SPDX-License-Identifier: Apache-2.0
// Files dropped on the page or chosen: uploads them; the server opens the main file, the last one sent.

// Main files by rank: a scene before its buffers, materials and pictures.
const order = [".gltf", ".obj", ".dae", ".3ds", ".fbx"];
const rank = name => { const at = order.findIndex(end => name.toLowerCase().endsWith(end)); return at < 0 ? order.length : at; };

export class Drop {
  // on: {maxBytes(), address(name, more), began(text), ended(text), failed(text)}
  constructor(by, on) {
    Object.assign(this, {by, on});
    const files = event => [...(event.dataTransfer?.types ?? [])].includes("Files");
    let inside = 0;
    addEventListener("dragenter", event => { if (files(event)) { ++inside; by("drop").hidden = false; } });
    addEventListener("dragleave", event => { if (files(event) && --inside <= 0) { inside = 0; by("drop").hidden = true; } });
    addEventListener("dragover", event => { if (files(event)) event.preventDefault(); });
    addEventListener("drop", event => {
      if (!files(event)) return;
      event.preventDefault();
      inside = 0;
      by("drop").hidden = true;
      this.open([...event.dataTransfer.files]);
    });
    by("file").addEventListener("change", event => { this.open([...event.target.files]); event.target.value = ""; });
    by("open").addEventListener("click", () => by("file").click());
  }

  async open(files) {
    if (!files.length) return this.on.failed("Only files can be opened");
    files.sort((a, b) => rank(b.name) - rank(a.name) || a.size - b.size);  // the main file is sent last
    const large = files.find(file => file.size > this.on.maxBytes());
    if (large) return this.on.failed(`${large.name} has ${(large.size / 1e9).toPrecision(3)} GB; --memory allows ${(this.on.maxBytes() / 1e9).toPrecision(3)}. Open it with hogel view`);
    try {
      for (const file of files) {
        this.on.began(`Sending ${file.name}`);
        const answer = await fetch(this.on.address(file.name, file !== files.at(-1)), {method: "POST", body: file});
        if (!answer.ok) {
          const text = await answer.text();
          let why = text;
          try { why = JSON.parse(text).message; } catch { /* a line of text */ }
          throw new Error(why);
        }
      }
      this.on.ended(`Opening ${files.at(-1).name}`);
    } catch (error) { this.on.failed(`Not opened: ${error.message}`); }
  }
}

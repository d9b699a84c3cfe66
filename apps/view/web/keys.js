// SPDX-License-Identifier: Apache-2.0
// Table of keys: key, help text, action. `to` holds the page's actions.

export const keys = to => [
  {shown: "← → ↑ ↓", text: "Move the eye, the scene or the light; with Shift, further", keys: ["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown"], act: (key, shift) => {
    const step = shift ? 0.2 : 0.04;
    to.move({ArrowLeft: -step, ArrowRight: step}[key] ?? 0, {ArrowUp: step, ArrowDown: -step}[key] ?? 0);
  }},
  {shown: "+ −", text: "Nearer, farther", keys: ["+", "=", "-"], act: key => to.zoom(key === "-" ? 1.1 : 1 / 1.1)},
  {shown: "[ ]", text: "Focus nearer, deeper", keys: ["[", "]"], act: key => to.step("focus", key === "]" ? 1 : -1)},
  {shown: ", .", text: "Narrower, wider pupil", keys: [",", "."], act: key => to.step("pupil", key === "." ? 1 : -1)},
  {shown: "d b", text: "Darker, brighter", keys: ["d", "b"], act: key => to.step("stops", key === "b" ? 1 : -1)},
  {shown: "t", text: "Tone: linear light or its logarithm", keys: ["t"], act: () => to.tone()},
  {shown: "2", text: "Two eyes side by side, or one", keys: ["2"], act: () => to.stereo()},
  {shown: "w", text: "Photographed by rays, waves, both side by side, their difference; of a compressed file its error", keys: ["w"], act: () => to.method()},
  {shown: "i", text: "Look inside: the next kind of picture", keys: ["i"], act: () => to.inside()},
  {shown: "g", text: "What dragging and arrows move: eye, scene, light", keys: ["g"], act: () => to.dragging()},
  {shown: "m", text: "Make this: the command line for the scene as it is", keys: ["m"], act: () => to.make()},
  {shown: "o", text: "Open a file; one that is dropped on the page is opened too", keys: ["o"], act: () => to.open()},
  {shown: "h", text: "Histogram of a modulator's levels (holograms)", keys: ["h"], act: () => to.levels()},
  {shown: "p", text: "Find planes in focus (holograms)", keys: ["p"], act: () => to.find()},
  {shown: "Enter", text: "Focus on the middle of the picture", keys: ["Enter"], act: () => to.focusMiddle()},
  {shown: "0", text: "Reset the view", keys: ["0"], act: () => to.reset()},
  {shown: "s", text: "Save the picture as PNG", keys: ["s"], act: () => to.save()},
  {shown: "e", text: "Save it as EXR, in linear light", keys: ["e"], act: () => to.save("exr")},
  {shown: "c", text: "Copy the command that repeats it", keys: ["c"], act: () => to.copyCommand()},
  {shown: "l", text: "Copy a link to this view", keys: ["l"], act: () => to.copyLink()},
  {shown: "f", text: "Full screen", keys: ["f"], act: () => to.full()},
  {shown: "?", text: "This table", keys: ["?"], act: () => to.help()},
];

export function listen(table) {
  document.addEventListener("keydown", event => {
    const target = event.target;
    if (event.ctrlKey || event.metaKey || event.altKey || document.querySelector("dialog[open]")) return;
    // Focused controls keep their own keys.
    if (target.matches("select, input[type=text]") || (target.matches("input") && event.key.startsWith("Arrow"))) return;
    if (target.matches("button, input") && event.key === "Enter") return;
    const row = table.find(each => each.keys.includes(event.key));
    if (!row) return;
    event.preventDefault();
    row.act(event.key, event.shiftKey);
  });
}

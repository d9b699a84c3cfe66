// SPDX-License-Identifier: Apache-2.0
// How fast the page of `hogel view` is, both ends on this machine: pictures a second and the time from input to picture while
// something is dragged, and the time to the first picture.
//
// usage: node speed.mjs HOGEL INPUT [SECONDS [BY [OPTIONS OF hogel view ...]]]     BY: rays or waves; writes a row of a table
// The processor time that a picture takes at both ends says, on a machine that has other work too, what a free one could do.
import {readFileSync, readdirSync} from "node:fs";
import {ended, launch, ready, serve} from "./server.mjs";

// Seconds of processor time of a process, and of all below this one.
const stat = pid => { try { return readFileSync(`/proc/${pid}/stat`, "latin1").replace(/^.*\) /s, "").split(" "); } catch { return null; } };
const time = words => (Number(words[11]) + Number(words[12])) / 100;
function below(root) {
  const parents = new Map(readdirSync("/proc").filter(name => /^\d+$/.test(name)).map(pid => [Number(pid), stat(pid)]).filter(each => each[1]));
  const descends = pid => { for (; pid > 1; pid = Number(parents.get(pid)?.[1] ?? 0)) if (pid === root) return true; return false; };
  return [...parents].filter(([pid]) => descends(pid)).reduce((sum, [, words]) => sum + time(words), 0);
}

const [hogel, input, seconds = "5", by = "rays", ...options] = process.argv.slice(2);
const browser = await launch();
const server = await serve(hogel, input, ...options);
const page = await browser.newPage({viewport: {width: 1280, height: 800}});
const opened = Date.now();
await page.goto(server.address);
await page.waitForFunction(() => document.getElementById("timing").textContent !== "", null, {timeout: 60000});
const first = Date.now() - opened;
await ready(page);
if (by === "waves") {  // whose first picture prepares them
  await page.selectOption("#by", "waves");
  await page.waitForFunction(() => document.getElementById("timing").textContent.includes("look 1 of 1"), null, {timeout: 120000});
}

const before = {all: below(process.pid), server: time(stat(server.pid))};

// A pointer that circles, moved by the page itself with each frame of the screen, so that the driver costs nothing.
const told = await page.evaluate(seconds => new Promise(resolve => {
  const canvas = document.getElementById("picture"), box = canvas.getBoundingClientRect(), latencies = [];
  const at = angle => ({bubbles: true, pointerId: 1, button: 0, buttons: 1, clientX: box.left + box.width * (0.5 + 0.2 * Math.cos(angle)),
                        clientY: box.top + box.height * (0.5 + 0.2 * Math.sin(angle))});
  canvas.setPointerCapture = () => {};
  canvas.addEventListener("hogel-picture", event => { if (event.detail.pupil_samples === 4) latencies.push([event.detail.latency, event.detail.seconds * 1e3, event.detail.width]); });
  canvas.dispatchEvent(new PointerEvent("pointerdown", at(0)));
  const began = performance.now();
  (function frame() {
    const passed = (performance.now() - began) / 1000;
    canvas.dispatchEvent(new PointerEvent("pointermove", at(2 * passed)));
    if (passed < seconds) return void requestAnimationFrame(frame);
    canvas.dispatchEvent(new PointerEvent("pointercancel", at(0)));
    const median = index => latencies.map(each => each[index]).sort((a, b) => a - b)[latencies.length >> 1];
    resolve({count: latencies.length, rate: latencies.length / passed, latency: median(0), made: median(1), width: latencies[0]?.[2]});
  })();
}), Number(seconds));
const all = below(process.pid) - before.all, own = time(stat(server.pid)) - before.server, each = seconds => (1e3 * seconds / told.count).toFixed(1);
console.log(`| ${await page.locator("#facts").textContent()} | ${told.width} | ${told.rate.toFixed(1)} | ${told.latency.toFixed(0)} ms | ${told.made.toFixed(0)} ms | ${each(own)} ms | ${each(all - own)} ms | ${first} ms |`);
await browser.close();
await ended(server);

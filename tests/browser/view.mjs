// SPDX-License-Identifier: Apache-2.0
// The page of `hogel view` in Chromium, as a person uses it.
//
// usage: node view.mjs HOGEL [FOLDER]    FOLDER: where screenshots go
//
// Needs playwright-core (npm install playwright-core; NODE_PATH names its folder) and Debian's chromium. Exit status 77 says that
// one of them is missing.
import {ended, launch, ready, serve} from "./server.mjs";
import {execFileSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import path from "node:path";

const [hogel, shots] = process.argv.slice(2).map(name => path.resolve(name));
const folder = mkdtempSync(path.join(tmpdir(), "hogel-browser-")), input = "pumpkin.h5";
process.chdir(folder);
const failures = [];
const expect = (truth, what) => { if (!truth) { failures.push(what); console.log(`wrong: ${what}`); } };

// The next picture at rest, by what the page says of it.
const picture = (page, samples = 16) => page.evaluate(samples => new Promise((resolve, reject) => {
  const canvas = document.getElementById("picture"), late = setTimeout(() => reject(new Error("no picture came")), 20000);
  canvas.addEventListener("hogel-picture", function listen(event) {
    if (event.detail.pupil_samples !== samples) return;
    canvas.removeEventListener("hogel-picture", listen);
    clearTimeout(late);
    resolve(event.detail);
  });
}), samples);

// What the canvas shows against `hogel photo` with the command line that the page gives.
async function psnr(page) {
  await page.evaluate(() => { window.copied = ""; navigator.clipboard.writeText = async text => { window.copied = text; }; });
  await page.keyboard.press("c");
  const command = await page.waitForFunction(() => window.copied).then(handle => handle.jsonValue());
  const words = command.replace("view.png", path.join(folder, "photo.png")).split(" ").slice(1);
  execFileSync(hogel, [...words, "-q"]);
  const url = await page.evaluate(() => document.getElementById("picture").toDataURL("image/png"));
  writeFileSync(path.join(folder, "canvas.png"), Buffer.from(url.split(",")[1], "base64"));
  const told = execFileSync(hogel, ["compare", path.join(folder, "photo.png"), path.join(folder, "canvas.png"), "--json"]);
  return JSON.parse(told).psnr ?? Infinity;
}

async function run() {
  const browser = await launch();
  execFileSync(hogel, ["render", "pumpkin", "-o", input, "--hogels", "120", "--directions", "24", "--depth", "-q"]);
  let server = await serve(hogel, input);
  const context = await browser.newContext({viewport: {width: 1280, height: 800}, acceptDownloads: true});
  const page = await context.newPage();
  const said = [], elsewhere = [];
  page.on("console", message => { if (["error", "warning"].includes(message.type())) said.push(message.text()); });
  page.on("pageerror", error => said.push(String(error)));
  page.on("request", request => { if (!request.url().startsWith(server.address) && !request.url().startsWith("blob:")) elsewhere.push(request.url()); });
  await page.goto(server.address);
  await ready(page);

  // A drag moves the eye against the pointer, with coarse pictures on the way and a fine one at rest.
  const box = await page.locator("#picture").boundingBox(), middle = [box.x + box.width / 2, box.y + box.height / 2];
  let coarse = picture(page, 4), fine = picture(page);
  await page.mouse.move(...middle);
  await page.mouse.down();
  for (let i = 1; i <= 10; ++i) await page.mouse.move(middle[0] + 8 * i, middle[1] - 4 * i);
  await page.mouse.up();
  await coarse;
  await fine;
  const eye = (await page.locator("#eye").textContent()).split(",").map(parseFloat);
  expect(eye[0] < -1 && eye[1] < -0.5, `the eye after a drag to the right and up is at ${eye}`);
  const likeness = await psnr(page);
  expect(likeness > 40, `after a drag the picture differs from hogel photo: ${likeness} dB`);
  console.log(`picture after a drag beside hogel photo: ${likeness.toFixed(1)} dB`);

  // The address holds the view.
  await page.waitForFunction(() => location.hash.includes("eye="));
  const link = page.url();
  const other = await context.newPage();
  await other.goto(link);
  await other.waitForFunction(() => document.getElementById("timing").textContent !== "");
  expect(await other.locator("#eye").textContent() === await page.locator("#eye").textContent(), "a link shows another view");
  await other.close();

  // A click focuses on what is there.
  await page.keyboard.press("0");
  await picture(page);
  fine = picture(page);
  await page.mouse.click(...middle);
  await fine;
  const focus = parseFloat(await page.locator("#focus-out").textContent());
  const state = await page.evaluate(async () => {
    const canvas = document.getElementById("picture"), query = new URLSearchParams({eye: "0,0,300mm", resolution: `${canvas.width}x${canvas.height}`, x: 0.5, y: 0.5});
    return (await fetch("/reading?" + query)).json();
  });
  expect(Math.abs(focus - 1e3 * state.depth_m) < 0.2, `a click focuses at ${focus} mm; the depth there is ${1e3 * state.depth_m} mm`);

  // Keys do what the table says, sliders and the wheel too.
  for (const [key, id] of [["ArrowLeft", "eye"], ["+", "distance-out"], ["]", "focus-out"], [".", "pupil-out"], ["b", "stops-out"]]) {
    const before = await page.locator(`#${id}`).textContent();
    await page.keyboard.press(key);
    expect(await page.locator(`#${id}`).textContent() !== before, `the key ${key} changes nothing`);
  }
  await page.keyboard.press("?");
  expect(await page.locator("#keys").isVisible(), "? shows no table of keys");
  await page.keyboard.press("Escape");
  expect(!(await page.locator("#keys").isVisible()), "Escape does not close the table of keys");
  const distance = await page.locator("#distance-out").textContent();
  await page.mouse.wheel(0, 200);
  await page.waitForFunction(before => document.getElementById("distance-out").textContent !== before, distance);
  const [download] = await Promise.all([page.waitForEvent("download"), page.keyboard.press("s")]);
  expect(readFileSync(await download.path()).subarray(1, 4).toString() === "PNG", "the saved picture is no PNG file");

  // Two eyes have two pictures, of the distance between them.
  await page.keyboard.press("0");
  await picture(page);
  fine = picture(page);
  await page.keyboard.press("2");
  const pair = await fine;
  expect(pair.width >= 1.9 * pair.height, `two pictures of a square hologram have ${pair.width} x ${pair.height} pixels`);
  await page.waitForFunction(() => location.hash.includes("eyes=63mm"));
  const views = await page.evaluate(async () => {
    const reading = x => fetch("/reading?" + new URLSearchParams({eye: "0,0,300mm", eyes: "63mm", x, y: 0.5})).then(answer => answer.json());
    return [await reading(0.25), await reading(0.75)];
  });
  const eyes = views.map(each => 1e3 * each.x_m - 300 * Math.tan(each.across_deg * Math.PI / 180));
  expect(Math.abs(eyes[0] + 31.5) < 0.1 && Math.abs(eyes[1] - 31.5) < 0.1, `two eyes at ${eyes} mm`);
  if (shots) await page.screenshot({path: path.join(shots, "view_stereo.png")});
  fine = picture(page);
  await page.keyboard.press("2");
  await fine;

  // A reading under the pointer.
  await page.mouse.move(middle[0] + 3, middle[1]);
  await page.waitForFunction(() => document.getElementById("reading").textContent.includes("on the hologram"));

  // Every control has a name, and nothing is wider than the page.
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas, progress")]
    .filter(each => !(each.textContent.trim() || each.labels?.length || each.getAttribute("aria-label"))).map(each => each.id));
  expect(nameless.length === 0, `without a name: ${nameless}`);
  for (const scheme of ["light", "dark"])
    for (const [width, height] of [[390, 844], [820, 1180], [1440, 900]]) {
      await page.emulateMedia({colorScheme: scheme, reducedMotion: "reduce"});
      await page.setViewportSize({width, height});
      await page.waitForTimeout(700);
      expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), `at ${width} pixels the page is wider than the screen`);
      if (shots) await page.screenshot({path: path.join(shots, `view_${scheme}_${width}.png`)});
    }
  if (shots) {
    await page.keyboard.press("?");
    await page.screenshot({path: path.join(shots, "view_keys.png")});
    await page.keyboard.press("Escape");
  }
  expect(said.length === 0, `the console says: ${said}`);

  // A server that is lost is missed, and found again.
  const port = Number(new URL(server.address).port);
  await ended(server);
  await page.waitForFunction(() => !document.getElementById("problem").hidden);
  if (shots) await page.screenshot({path: path.join(shots, "view_lost.png")});
  server = await serve(hogel, input, "--port", String(port));
  await page.waitForFunction(() => document.getElementById("problem").hidden, null, {timeout: 20000});
  await page.evaluate(() => document.getElementById("picture").focus());
  fine = picture(page);
  await page.keyboard.press("ArrowRight");
  await fine;
  expect(elsewhere.length === 0, `requests leave the machine: ${elsewhere}`);
  await browser.close();
  await ended(server);
}

try { await run(); } finally { process.chdir(tmpdir()); rmSync(folder, {recursive: true, force: true}); }
console.log(failures.length ? `${failures.length} wrong` : "drag, link, focus, keys, save, two eyes, reading, names, widths, lost server");
process.exit(failures.length ? 1 : 0);

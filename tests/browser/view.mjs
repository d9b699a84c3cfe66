// SPDX-License-Identifier: Apache-2.0
// The page of `hogel view` in Chromium, as a person uses it.
//
// usage: node view.mjs HOGEL [FOLDER]    FOLDER: where screenshots go
//
// Needs playwright-core (npm install playwright-core; NODE_PATH names its folder) and Debian's chromium. Exit status 77 says that
// one of them is missing.
import {atEveryWidth, ended, launch, ready, serve} from "./server.mjs";
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
  const canvas = document.getElementById("picture"), late = setTimeout(() => reject(new Error("no picture came")), 60000);
  canvas.addEventListener("hogel-picture", function listen(event) {
    if (event.detail.pupil_samples !== samples) return;
    canvas.removeEventListener("hogel-picture", listen);
    clearTimeout(late);
    resolve(event.detail);
  });
}), samples);

const text = (page, id) => page.locator(`#${id}`).textContent();

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

// A picture that cannot be made marks the controls of the parameters that it names, until another one is made.
async function refusals(page) {
  await page.evaluate(() => { location.hash = "#eye=90,0,100mm"; });
  await page.waitForSelector("#distance[aria-invalid=true]");
  const marked = await page.evaluate(() => [...document.querySelectorAll("[aria-invalid]")].map(each => each.id));
  expect(marked.includes("distance") && !marked.includes("pupil"), `an eye that sees nothing marks ${marked}`);
  const told = await page.locator("#distance").evaluate(each => document.getElementById(each.getAttribute("aria-errormessage")) !== null);
  expect(told && await text(page, "wrong") === await text(page, "problem-text"), "no message at the control that is marked");
  await page.locator("#distance").scrollIntoViewIfNeeded();
  if (shots) await page.screenshot({path: path.join(shots, "hologram_refused.png")});
  await page.locator("#reset").click();
  await page.waitForFunction(() => document.getElementById("problem").hidden && !document.querySelector("[aria-invalid], #wrong"));
}

// A hologram: photographs by waves, fringes, and the focus finder, by which one goes to a plane.
async function holograms(context) {
  execFileSync(hogel, ["render", "sphere", "-o", "sphere.h5", "--hogels", "40", "--directions", "12", "--size", "4mm", "-q"]);
  execFileSync(hogel, ["hologram", "sphere.h5", "-o", "hologram.h5", "--pitch", "2.2um", "--wavelength", "633nm", "-q"]);
  const server = await serve(hogel, "hologram.h5"), page = await context.newPage();
  page.on("pageerror", error => expect(false, `hologram: ${error}`));
  await page.goto(server.address);
  await ready(page);
  expect(!(await page.locator("#by").isVisible()), "a hologram is offered by rays");
  expect((await page.locator("#facts").textContent()).includes("efficiency"), "the facts of a hologram");
  for (const what of ["intensity", "phase", "real", "spectrum"]) {
    await page.selectOption("#inside-what", what);
    await page.waitForFunction(what => document.getElementById("inside-picture").naturalWidth > 0 && document.getElementById("inside-what").value === what, what);
    await page.waitForTimeout(300);
    if (shots) await page.screenshot({path: path.join(shots, `hologram_${what}.png`)});
  }
  await page.locator("#find").click();
  await page.waitForSelector("#finder-plot svg", {timeout: 60000});
  const box = await page.locator("#finder-plot svg").boundingBox(), before = await page.locator("#focus-out").textContent();
  await page.mouse.click(box.x + 0.2 * box.width, box.y + 0.5 * box.height);
  expect(await page.locator("#focus-out").textContent() !== before, "a click on the plot does not go to a depth");
  if (shots) await page.screenshot({path: path.join(shots, "hologram_finder.png")});
  await refusals(page);
  await page.close();
  await ended(server);
}

async function run() {
  const browser = await launch();
  execFileSync(hogel, ["render", "pumpkin", "-o", input, "--hogels", "120", "--directions", "24", "--depth", "-q"]);
  let server = await serve(hogel, input, "--looks", "2");
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

  // Waves appear with one look and refine; the command repeats them. A link holds the method.
  const shown = (page, test) => page.evaluate(test => new Promise((resolve, reject) => {
    const canvas = document.getElementById("picture"), looks = [], wanted = new Function("about", `return ${test}`);
    const late = setTimeout(() => reject(new Error(`no picture with ${test} came`)), 180000);
    canvas.addEventListener("hogel-picture", function listen(event) {
      if (event.detail.looks) looks.push(event.detail.looks);
      if (!wanted(event.detail)) return;
      canvas.removeEventListener("hogel-picture", listen);
      clearTimeout(late);
      resolve({...event.detail, seen: looks});
    });
  }), test);
  // Until the first are there it is said that they are computed, if that takes long enough to be read.
  await page.evaluate(() => {
    const said = document.getElementById("said"), since = performance.now();
    window.told = [];
    new MutationObserver(() => window.told.push(said.textContent)).observe(said, {childList: true});
    document.getElementById("picture").addEventListener("hogel-picture", () => { window.waited = performance.now() - since; }, {once: true});
  });
  let waves = shown(page, "about.looks === 2 && about.of_looks === 2");
  await page.selectOption("#by", "waves");
  const refined = await waves;
  const {told, waited} = await page.evaluate(() => ({told: window.told, waited: window.waited}));
  expect(waited < 500 || told.includes("Computing waves; until then by rays"), `while waves are computed the page says: ${told}`);
  expect(await text(page, "said") === "", "the page still says that waves are computed");
  expect(refined.seen[0] === 1, `looks that were shown: ${refined.seen}`);
  expect((await page.locator("#timing").textContent()).includes("look 2 of 2"), "the page does not say how many looks there are");
  await page.waitForFunction(() => location.hash.includes("by=waves"));
  const likenessOfWaves = await psnr(page);
  expect(likenessOfWaves > 40, `waves differ from hogel photo: ${likenessOfWaves} dB`);
  console.log(`waves, 2 looks, beside hogel photo: ${likenessOfWaves.toFixed(1)} dB`);
  waves = shown(page, "about.looks === 2 && about.psnr !== undefined");
  await page.locator("#picture").focus();
  await page.keyboard.press("w");
  const side = await waves;
  expect(side.width >= 1.9 * side.height, `side by side there are ${side.width} x ${side.height} pixels`);
  if (shots) await page.screenshot({path: path.join(shots, "view_side.png")});
  waves = shown(page, "about.looks === 2 && about.psnr !== undefined");
  await page.keyboard.press("w");
  await waves;
  if (shots) await page.screenshot({path: path.join(shots, "view_difference.png")});
  fine = picture(page);
  await page.keyboard.press("w");
  await fine;
  expect(await page.locator("#by").inputValue() === "rays", "w does not come back to rays");

  // A look inside follows the pointer.
  const inside = page => page.evaluate(() => new Promise(resolve => document.getElementById("inside-picture").addEventListener("hogel-inside", event => resolve(event.detail), {once: true})));
  for (const what of ["hogel", "views", "s-u", "t-v", "depth"]) {
    const came = inside(page);
    await page.selectOption("#inside-what", what);
    expect((await came).what === what, `a look at ${what}`);
    if (shots) await page.screenshot({path: path.join(shots, `inside_${what}.png`)});
  }
  const followed = inside(page);
  await page.selectOption("#inside-what", "hogel");
  await followed;
  await page.mouse.move(middle[0] + 10, middle[1]);
  await inside(page);
  await page.locator("#inside-large").click();
  expect(await page.locator("#large").isVisible(), "the look inside does not become large");
  await page.keyboard.press("Escape");

  // A reading under the pointer.
  await page.mouse.move(middle[0] + 3, middle[1]);
  await page.waitForFunction(() => document.getElementById("reading").textContent.includes("on the hologram"));

  // Every control has a name, and nothing is wider than the page.
  const nameless = await page.evaluate(() => [...document.querySelectorAll("button, input, select, canvas, progress")]
    .filter(each => !(each.textContent.trim() || each.labels?.length || each.getAttribute("aria-label"))).map(each => each.id));
  expect(nameless.length === 0, `without a name: ${nameless}`);
  await atEveryWidth(page, async (fits, scheme, width) => {
    expect(fits, `at ${width} pixels the page is wider than the screen`);
    if (shots) await page.screenshot({path: path.join(shots, `view_${scheme}_${width}.png`)});
  });
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
  await page.setViewportSize({width: 390, height: 844});
  const box390 = await page.locator("#problem").boundingBox();
  expect(box390.width > 0.85 * 390, `on a phone a message is ${box390.width} pixels wide`);
  if (shots) await page.screenshot({path: path.join(shots, "view_lost.png")});
  server = await serve(hogel, input, "--looks", "2", "--port", String(port));
  await page.waitForFunction(() => document.getElementById("problem").hidden, null, {timeout: 60000});
  await page.evaluate(() => document.getElementById("picture").focus());
  fine = picture(page);
  await page.keyboard.press("ArrowRight");
  await fine;
  await holograms(context);
  expect(elsewhere.length === 0, `requests leave the machine: ${elsewhere}`);
  await browser.close();
  await ended(server);
}

try { await run(); } finally { process.chdir(tmpdir()); rmSync(folder, {recursive: true, force: true}); }
console.log(failures.length ? `${failures.length} wrong` : "drag, link, focus, keys, save, two eyes, waves, insides, hologram, reading, names, widths, lost server");
process.exit(failures.length ? 1 : 0);

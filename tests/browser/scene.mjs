// SPDX-License-Identifier: Apache-2.0
// Scenes that change, files that are dropped, and compressed light fields on the page of `hogel view`, in Chromium.
//
// usage: node scene.mjs HOGEL [FOLDER]    FOLDER: where screenshots go
//
// Needs what view.mjs needs; exit status 77 says that it is missing.
import {atEveryWidth, ended, launch, ready, serve} from "./server.mjs";
import {execFileSync, execSync} from "node:child_process";
import {mkdtempSync, readFileSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import path from "node:path";

const [hogel, shots] = process.argv.slice(2).map(name => path.resolve(name));
const folder = mkdtempSync(path.join(tmpdir(), "hogel-browser-"));
process.chdir(folder);
process.env.PATH = `${path.dirname(hogel)}:${process.env.PATH}`;
const failures = [];
const expect = (truth, what) => { if (!truth) { failures.push(what); console.log(`wrong: ${what}`); } };
const shot = async (page, name) => { if (shots) await page.screenshot({path: path.join(shots, `${name}.png`)}); };
const text = (page, id) => page.locator(`#${id}`).textContent();

async function open(browser, server, options = {}) {
  const page = await browser.newPage({viewport: {width: 1280, height: 800}, ...options});
  page.on("console", message => expect(!["error", "warning"].includes(message.type()) || message.text().includes("status of"), `the console says: ${message.text()}`));
  page.on("pageerror", error => expect(false, String(error)));
  page.on("request", request => expect(request.url().startsWith(server.address) || request.url().startsWith("blob:"), `a request leaves the machine: ${request.url()}`));
  await page.goto(server.address);
  await ready(page);
  return page;
}

// Does what changes the scene, and waits until its last picture is there: of all hogels, at rest.
async function after(page, act) {
  const before = await page.evaluate(() => { window.pictures = window.pictures ?? (document.getElementById("picture").addEventListener("hogel-picture", event => { ++window.pictures; window.last = event.detail; }), 0); return window.pictures; });
  await act();
  await page.waitForTimeout(500);  // longer than a pause in what is dragged
  await page.waitForFunction(() => document.getElementById("cover").hidden, null, {timeout: 120000});
  await page.waitForFunction(before => window.pictures > before && window.last.pupil_samples === 16, before, {timeout: 60000});
  await page.waitForTimeout(400);
}

const slide = (page, id, value) => page.evaluate(([id, value]) => {
  const input = document.getElementById(id);
  input.value = value;
  input.dispatchEvent(new Event("input"));
}, [id, value]);

// What the canvas shows against the command line that the page gives.
async function psnr(page) {
  await page.evaluate(() => { window.copied = ""; navigator.clipboard.writeText = async text => { window.copied = text; }; });
  await page.locator("#picture").focus();
  await page.keyboard.press("c");
  const command = await page.waitForFunction(() => window.copied).then(handle => handle.jsonValue());
  execSync(`${command} -q`);
  const url = await page.evaluate(() => document.getElementById("picture").toDataURL("image/png"));
  writeFileSync("canvas.png", Buffer.from(url.split(",")[1], "base64"));
  return JSON.parse(execFileSync(hogel, ["compare", "view.png", "canvas.png", "--json"])).psnr ?? Infinity;
}

async function scenes(browser) {
  const server = await serve(hogel, "pumpkin", "--hogels", "100", "--directions", "24", "--looks", "1");
  const page = await open(browser, server);
  expect(await page.locator("#scene").isVisible(), "a scene has no sliders");
  await shot(page, "scene");

  // A drag turns the scene about the viewer's axes; arrow keys do too.
  const box = await page.locator("#picture").boundingBox(), middle = [box.x + box.width / 2, box.y + box.height / 2];
  await page.locator("#picture").focus();
  await page.keyboard.press("g");
  expect(await page.evaluate(() => document.querySelector("input[name=dragging]:checked").value) === "scene", "g does not choose what moves");
  await after(page, async () => {
    await page.mouse.move(...middle);
    await page.mouse.down();
    for (let i = 1; i <= 12; ++i) { await page.mouse.move(middle[0] + i * box.width / 60, middle[1] + i * box.height / 120); await page.waitForTimeout(30); }
    await page.mouse.up();
  });
  const turned = await text(page, "turn-out"), eye = await text(page, "eye");
  expect(Math.abs(parseFloat(turned) - 36) < 6 && eye.startsWith("0.0, 0.0"), `a drag by a fifth of the picture turns the scene by ${turned}, the eye is at ${eye}`);
  await after(page, () => page.keyboard.press("ArrowRight"));
  expect(parseFloat(await text(page, "turn-out")) > parseFloat(turned), "an arrow key does not turn the scene");
  const likeness = await psnr(page);
  expect(likeness > 40, `a turned scene differs from the command that is copied: ${likeness} dB`);
  console.log(`a turned scene beside hogel photo: ${likeness.toFixed(1)} dB`);

  // The light, sampling and what cannot be.
  const dark = await page.evaluate(() => document.getElementById("picture").toDataURL().length);
  await after(page, () => slide(page, "light-strength", 6));
  expect(await page.locator("#own-lights").isVisible() && await page.evaluate(() => document.getElementById("picture").toDataURL().length) !== dark, "a light changes nothing");
  await after(page, () => slide(page, "hogels", Math.log10(120)));
  expect((await text(page, "facts")).startsWith("120 × 120 hogels"), await text(page, "facts"));
  await after(page, () => slide(page, "pitch", Math.log10(5)));
  expect((await text(page, "pitch-advice-text")).includes("aliases"), "a pitch that aliases is not told");
  await page.locator("#pitch-advice").scrollIntoViewIfNeeded();
  await shot(page, "scene_advice");
  await after(page, () => page.locator("[data-enough=pitch]").click());
  expect(await page.locator("#pitch-advice").isHidden(), `the number that would do does not: ${await text(page, "pitch-out")}`);
  await after(page, () => slide(page, "directions", Math.log10(5)));
  expect((await text(page, "directions-advice-text")).includes("would do"), "too few directions are not told");
  await after(page, () => page.locator("[data-enough=directions]").click());
  expect(await page.locator("#directions-advice").isHidden(), "the directions that would do do not");

  // The command line that makes it, and a link that shows it.
  await page.locator("#make").click();
  const made = await text(page, "made-command");
  for (const word of ["--hogels 120", "--rotate", "--light", "--pitch"]) expect(made.includes(word), `${made} lacks ${word}`);
  await shot(page, "scene_make");
  await page.keyboard.press("Escape");
  const link = page.url();
  expect(link.includes("hogels=120") && link.includes("rotate="), `the address ${link}`);
  await after(page, () => page.locator("#as-given").click());
  expect((await text(page, "facts")).startsWith("100 × 100 hogels of 24"), "the scene is not as it was");
  const other = await browser.newPage();
  await other.goto(link);
  await other.waitForFunction(() => document.getElementById("facts").textContent.startsWith("120 × 120"), null, {timeout: 60000});
  await other.close();

  // A change that is refused marks its control until it is moved.
  await page.evaluate(() => { location.hash = "#rotate=1"; });
  await page.waitForSelector("#turn[aria-invalid=true]");
  const marked = await page.evaluate(() => [...document.querySelectorAll("[aria-invalid]")].map(each => each.id).join());
  expect(marked === "turn,tilt,roll", `a rotation that is none marks ${marked}`);
  expect(await page.evaluate(() => document.getElementById("wrong").parentElement === document.getElementById("turn").parentElement), "no message at the first control that is marked");
  await page.locator("#turn").scrollIntoViewIfNeeded();
  await shot(page, "scene_refused");
  await page.locator("#tilt").focus();
  await after(page, () => page.keyboard.press("ArrowRight"));
  expect(await page.evaluate(() => !document.querySelector("[aria-invalid], #wrong") && document.getElementById("problem").hidden), "a control that was moved stays marked");

  // Coverage, with its legend.
  await page.selectOption("#inside-what", "coverage");
  await page.waitForFunction(() => document.getElementById("inside-picture").naturalWidth > 0);
  expect(await page.locator("#legend").isVisible(), "coverage has no legend");
  await page.locator("#inside").scrollIntoViewIfNeeded();
  await shot(page, "inside_coverage");

  await atEveryWidth(page, async (fits, scheme, width) => {
    expect(fits, `at ${width} pixels the page is wider than the screen`);
    await shot(page, `scene_${scheme}_${width}`);
  });
  await page.close();
  await ended(server);
}

// Drops a file on the page as a person does.
const drop = (page, name, bytes) => page.evaluate(([name, bytes]) => {
  const data = new DataTransfer();
  data.items.add(new File([new Uint8Array(bytes)], name));
  for (const type of ["dragenter", "dragover", "drop"]) document.body.dispatchEvent(new DragEvent(type, {dataTransfer: data, bubbles: true, cancelable: true}));
}, [name, [...bytes]]);

async function files(browser) {
  execSync("hogel render sphere -o sphere.h5 --hogels 60 --directions 16 --size 6mm --depth -q && hogel compress sphere.h5 -o sphere.hgl --sqnr 30 -q");
  execSync("hogel hologram sphere.h5 -o hologram.h5 --pitch 2.2um --wavelength 633nm -q");
  const server = await serve(hogel, "sphere.h5");
  const page = await open(browser, server);
  expect(await page.locator("#scene").isHidden() && await page.locator("#layers-control").isHidden(), "a file has the sliders of a scene");

  // A broken file says so, and what was there stays.
  await drop(page, "broken.ply", Buffer.from("ply\nformat ascii 1.0\n"));
  await page.waitForFunction(() => document.getElementById("problem-text").textContent.includes("broken.ply"), null, {timeout: 60000});
  expect((await text(page, "problem-text")).startsWith("broken.ply"), await text(page, "problem-text"));
  expect(await text(page, "name") === "sphere.h5", "a broken file takes the place of another");
  await shot(page, "drop_broken");
  await page.locator("#dismiss").click();
  expect(await page.locator("#problem").isHidden(), "a message that stays");

  // Compressed: layers, rates, errors.
  await after(page, () => drop(page, "sphere.hgl", readFileSync("sphere.hgl")));
  await page.waitForFunction(() => document.getElementById("layers-hint").textContent.includes("no error"), null, {timeout: 60000});
  const layers = Number(await page.locator("#layers").getAttribute("max"));
  await after(page, () => slide(page, "layers", layers - 2));
  await page.waitForFunction(() => document.getElementById("layers-hint").textContent.includes("SQNR"), null, {timeout: 60000});
  expect((await page.url()).includes(`layers=${layers - 2}`), `the address ${page.url()}`);
  await page.selectOption("#by", "error");
  await page.selectOption("#inside-what", "rate");
  await page.waitForFunction(() => document.getElementById("legend-high").textContent.includes("bytes"));
  await page.waitForTimeout(800);
  await shot(page, "layers_error");
  await page.selectOption("#by", "original");
  await page.waitForTimeout(500);

  // A hologram: levels of a modulator. The button does what a drop does.
  await after(page, () => page.locator("#file").setInputFiles("hologram.h5"));
  await page.selectOption("#encoding", "double-phase");
  await page.locator("#count-levels").click();
  await page.waitForSelector("#levels-plot svg", {timeout: 60000});
  expect((await text(page, "levels-plot")).includes("Efficiency"), "no efficiency");
  await page.locator("#levels").scrollIntoViewIfNeeded();
  await shot(page, "levels");
  await page.close();
  await ended(server);
}

const browser = await launch();
try {
  await scenes(browser);
  await files(browser);
} finally {
  await browser.close();
  process.chdir(tmpdir());
  rmSync(folder, {recursive: true, force: true});
}
console.log(failures.length ? `${failures.length} wrong` : "turning, light, sampling, advice, make, link, coverage, widths, dropped files, layers, errors, rates, levels");
process.exit(failures.length ? 1 : 0);

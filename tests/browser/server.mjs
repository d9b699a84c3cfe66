// SPDX-License-Identifier: Apache-2.0
// What the programs of this folder share: `hogel view` and Chromium.
import {createRequire} from "node:module";
import {spawn} from "node:child_process";
import {existsSync} from "node:fs";

const skip = why => { console.log(`skipped: ${why}`); process.exit(77); };

// Debian's Chromium, driven by playwright-core; ends the program with status 77 where one of them is missing.
export async function launch() {
  const browser = ["/usr/bin/chromium", "/usr/bin/chromium-browser"].find(existsSync);
  if (!browser) skip("there is no chromium");
  let playwright;
  try { playwright = createRequire(import.meta.url)("playwright-core"); } catch { skip("there is no playwright-core (npm install playwright-core; NODE_PATH names its folder)"); }
  return playwright.chromium.launch({executablePath: browser, args: ["--no-sandbox", "--disable-gpu"]});
}

// Starts `hogel view`; `address` is what it prints.
export async function serve(hogel, input, ...options) {
  const server = spawn(hogel, ["view", input, "--no-browser", ...options], {stdio: ["ignore", "pipe", "inherit"]});
  process.once("exit", () => server.kill());  // also where a test fails
  server.address = await new Promise((resolve, reject) => {
    server.stdout.once("data", data => resolve(String(data).trim()));
    server.once("exit", status => reject(new Error(`hogel view ended with status ${status}`)));
  });
  return server;
}

export const ended = server => new Promise(resolve => { server.once("exit", resolve); server.kill("SIGTERM"); });

// Waits until the page shows a picture of the whole light field.
export async function ready(page) {
  await page.waitForFunction(() => document.getElementById("timing").textContent !== "", null, {timeout: 60000});
  await page.waitForFunction(() => document.getElementById("cover").hidden, null, {timeout: 120000});
}

// Shows the page in both themes at the widths of a phone, a tablet and a desktop, and calls `look` at each: whether the page
// fits into the width, the theme and the width.
export async function atEveryWidth(page, look) {
  for (const scheme of ["light", "dark"])
    for (const [width, height] of [[390, 844], [820, 1180], [1440, 900]]) {
      await page.emulateMedia({colorScheme: scheme, reducedMotion: "reduce"});
      await page.setViewportSize({width, height});
      await page.waitForTimeout(700);
      await look(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth), scheme, width);
    }
}

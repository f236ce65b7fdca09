// SPDX-License-Identifier: Apache-2.0
// A browser for tests: opens the page with a size and a colour scheme, waits for expected text, and checks the page. Every script
// is started as SCRIPT DRIVER ORIGIN TOKEN PICTURES BROWSER [ITS OWN...] by page_server.py, which executes its commands.
import { createRequire } from "node:module";
import { pathToFileURL } from "node:url";
import { readFile } from "node:fs/promises";
import { join } from "node:path";
import { createInterface } from "node:readline";

const PATIENCE_MS = 30_000;
// Messages that may appear in the console: those of the browser about answers that are rejected on purpose.
const EXPECTED = /Failed to load resource|WebSocket connection|GPU stall|GroupMarkerNotSet|Automatic fallback to software/;

const [driver, origin, token, pictures, program, ...more] = process.argv.slice(2);
export { more, origin };

const input = createInterface({ input: process.stdin });
const answers = input[Symbol.asyncIterator]();
export async function command(word) {
  console.log(`do ${word}`);
  await answers.next();
}

export class Browser {
  constructor(puppet, axe) {
    Object.assign(this, { puppet, axe, messages: [] });
  }

  static async launch() {
    const require = createRequire(pathToFileURL(join(driver, "x.js")));
    const puppeteer = (await import(pathToFileURL(require.resolve("puppeteer-core")))).default;
    const axe = await readFile(require.resolve("axe-core/axe.min.js"), "utf8");
    const puppet = await puppeteer.launch({ executablePath: program, headless: true, args: ["--no-sandbox", "--enable-unsafe-swiftshader"] });
    return new Browser(puppet, axe);
  }

  async open(where, { width = 1920, height = 1080, dark = false, token: with_token = true } = {}) {
    const page = await this.puppet.newPage();
    page.setDefaultTimeout(PATIENCE_MS);
    page.on("pageerror", (error) => this.messages.push(`${where}: ${error.message}`));
    page.on("console", (message) => {
      if (["error", "warn"].includes(message.type()) && !EXPECTED.test(message.text())) this.messages.push(`${where}: ${message.text()}`);
    });
    await page.setViewport({ width, height, isMobile: width < 700, hasTouch: width < 700 });
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: dark ? "dark" : "light" }]);
    await page.goto(`${origin}/${with_token ? `#token=${token}&` : "#"}/${where}`);
    return page;
  }

  // Runs every test by its name and ends the process, with 0 if all passed and the console has no unexpected messages.
  async run(tests) {
    let failed = 0;
    for (const [name, test] of Object.entries(tests)) {
      try {
        await test();
        console.log(`ok: ${name}`);
      } catch (error) {
        failed++;
        console.log(`FAILED: ${name}: ${error.message}`);
      }
    }
    for (const line of this.messages) console.log(`FAILED: console message: ${line}`);
    await this.puppet.close();
    process.exit(failed + this.messages.length === 0 ? 0 : 1);
  }

  // Checks that nothing is wider than the screen and axe-core finds nothing serious; saves a picture.
  async check_view(page, name) {
    const inner = page.viewport().width;
    const wide = await page.evaluate(() => document.documentElement.scrollWidth);
    await page.screenshot({ path: join(pictures, `${name}.png`) });
    check(wide <= inner, `${name}: ${wide} pixels wide on a screen of ${inner}`);
    await page.evaluate(this.axe);
    const { violations } = await page.evaluate(() => window.axe.run(document, { resultTypes: ["violations"] }));
    const serious = violations.filter(({ impact }) => ["serious", "critical"].includes(impact));
    check(serious.length === 0, `${name}: ${serious.map(({ id, nodes }) => `${id}: ${nodes.slice(0, 3).map(({ html, failureSummary }) => `${html} ${failureSummary}`).join(" | ")}`).join("\n")}`);
  }
}

export function check(right, otherwise) {
  if (!right) throw new Error(otherwise);
}

export async function sees(page, text) {
  try {
    await page.waitForFunction((wanted) => document.body.innerText.includes(wanted), {}, text);
  } catch {
    throw new Error(`'${text}' is not shown, but:\n${await page.evaluate(() => document.body.innerText)}`);
  }
}

export async function sees_no(page, text) {
  await page.waitForFunction((wanted) => !document.body.innerText.includes(wanted), {}, text)
    .catch(() => { throw new Error(`'${text}' is still shown`); });
}

export async function press(page, text) {
  await page.locator(`::-p-xpath(//button[normalize-space()='${text}'])`).click();
}

export async function fill(page, label, text) {
  const field = await page.waitForSelector(`::-p-aria(${label})`);
  await field.click({ count: 3 });
  await field.type(text);
}

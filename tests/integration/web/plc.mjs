// SPDX-License-Identifier: Apache-2.0
// The PLC view as plc.py describes.
import { Browser, check, fill, command, press, sees, sees_no } from "./browser.mjs";

const browser = await Browser.launch();
const powered = (page) => page.evaluate(() => document.querySelectorAll(".network .power").length);

await browser.run({
  async "Power flows, and a contact links to its variable, which can be forced"() {
    const page = await browser.open("plc", { width: 1280, height: 900 });
    await sees(page, "Start and stop the conveyor; it stays on until stopped");
    await page.waitForFunction(() => document.querySelectorAll(".network .power").length > 0);
    const before = await powered(page);
    await command("start=true");
    await page.waitForFunction((least) => document.querySelectorAll(".network .power").length > least + 4, {}, before);
    await page.waitForFunction(() => [...document.querySelectorAll(".value")].some((text) => text.textContent === "T#2s"));
    await browser.check_view(page, "plc-wide");
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await page.waitForFunction(() => document.querySelectorAll(".network .power").length > 0);
    await browser.check_view(page, "plc-phone");
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "dark" }]);
    await browser.check_view(page, "plc-phone-dark");
    await page.emulateMediaFeatures([{ name: "prefers-color-scheme", value: "light" }]);
    await page.setViewport({ width: 1280, height: 900 });
    // From a contact to its variable, and a force.
    await page.waitForSelector("a[aria-label^='conveyor::stop,']");  // the page was reloaded with its size
    await page.evaluate(() => document.querySelector("a[aria-label^='conveyor::stop,']").dispatchEvent(new MouseEvent("click", { bubbles: true })));
    const field = "[aria-label='New value of conveyor::stop']";  // next to the ladder
    await page.waitForSelector(field);
    await page.select(field, "true");
    await page.select("[aria-label='How long to force']", "3");  // until released
    await press(page, "Force");
    await sees(page, "1 value is forced");
    await sees(page, "Start and stop the conveyor");
    await page.waitForSelector("a[aria-label^='conveyor::stop,'][aria-label$='forced'] rect.forced");
    const first = () => document.querySelector("[aria-label^='Network 1: ']")?.getAttribute("aria-label") ?? "not found";
    await page.waitForFunction(() => document.querySelector("[aria-label^='Network 1: ']")?.getAttribute("aria-label").includes("stop off"))
      .catch(async () => { throw new Error(`the contact is not open: ${await page.evaluate(first)}`); });
    check((await powered(page)) < before + 4, "power flows although stop is forced");
    await browser.check_view(page, "plc-forced-wide");
  },

  async "One of several programs is selected, and stays selected"() {
    const page = await browser.open("plc", { width: 1280, height: 800 });
    await sees(page, "Start and stop the conveyor");
    await page.select(".plc select", "lamp");
    await sees(page, "flashes := flashes + 1;");
    await sees_no(page, "Start and stop the conveyor");
    await sees(page, "flashes = 0");
    await command("lit=true");
    await page.waitForFunction(() => /flashes = [1-9]/.test(document.body.innerText));
    await browser.check_view(page, "plc-text-wide");
    await page.reload();
    await sees(page, "flashes := flashes + 1;");
    await page.select(".plc select", "conveyor");
    await sees(page, "Start and stop the conveyor");
    await page.close();
  },

  async "A recipe is saved, compared, loaded in one tick, and removed"() {
    const page = await browser.open("recipes", { width: 1280, height: 800 });
    await sees(page, "This board has no recipes yet.");
    await command("conveyor::acknowledge=false");
    await fill(page, "Name", "clean");
    await fill(page, "Variable names", "conveyor::start conveyor::acknowledge");
    await fill(page, "Comment", "cleaning");
    await press(page, "Save current values");
    await sees(page, "clean: 2 values saved.");
    await press(page, "clean");
    await sees(page, "The recipe matches the current values.");
    await command("conveyor::acknowledge=true");
    await sees(page, "1 value differs from the current value.");
    await browser.check_view(page, "recipes-wide");
    await press(page, "load");
    await sees(page, "2 values loaded in tick ");
    await sees(page, "The recipe matches the current values.");
    await page.setViewport({ width: 390, height: 844, isMobile: true, hasTouch: true });
    await sees(page, "The recipe matches the current values.");
    await browser.check_view(page, "recipes-phone");
    await page.setViewport({ width: 1280, height: 800 });
    await press(page, "remove");
    await sees_no(page, "cleaning");
    await page.close();
  },
});

// SPDX-License-Identifier: Apache-2.0
// Guides an arm and shows what is around it, as guide.py describes it; its own argument is the node's name.
import { Browser, check, command, more, origin, press, sees, sees_no } from "./browser.mjs";

const [node] = more;
const WIDE = { width: 1500, height: 1100 };
const PHONE = { width: 390, height: 844, dark: true };
const PANEL = "section[aria-label='Guiding by hand']";

const browser = await Browser.launch();
const value_of = async (name) => (await (await fetch(`${origin}/api/v1/boards/${node}/variables/PLC_ROBOT::${name}`)).json()).value;
const until = async (what, condition) => {
  for (const end = Date.now() + 60_000; !(await condition());) {
    check(Date.now() < end, what);
    await new Promise((done) => setTimeout(done, 50));
  }
};
const open = async (size = WIDE) => {
  const page = await browser.open("robot", size);
  await page.locator(`${PANEL} summary`).click();
  return page;
};
// A browser that takes a picture may be too busy to keep the switch: then the button is no longer there.
const stop = (page) => page.$eval(`${PANEL} .stop`, (button) => button.click()).catch(() => undefined);
const say = (page) => page.$eval(PANEL, (panel) => panel.innerText);
// Not by its role: a busy browser takes long to describe all of a page that changes all the time.
const name_job = async (page, name) => {
  const field = await page.waitForSelector(`${PANEL} input[aria-label='Name of the job']`).catch(async () => { throw new Error(`no job can be written: ${await say(page)}`); });
  await field.click({ count: 3 });
  await field.type(name);
};

await browser.run({
  async "Guiding is offered in manual mode only, and not to readers"() {
    const page = await open();
    await sees(page, "Only in manual mode: its key switch (ROBOT_MODE) selects the mode.");
    check(await page.$eval(`${PANEL} button`, (button) => button.disabled), "it can be started");
    await page.close();
    const reader = await browser.open("robot", { ...WIDE, token: false });
    await sees(reader, "Current values");
    check(await reader.$(PANEL) === null, "a reader can guide");
    await reader.close();
  },

  async "The page shows why the robot cannot be guided"() {
    await command("manual");
    await command("lean");
    const page = await open();
    await sees_no(page, "Only in manual mode");
    await press(page, "Start guiding");
    await sees(page, "before guiding begins: release it first");
    await browser.check_view(page, "guide-refused");
    await stop(page);
    await until("the switch is not released", async () => !(await value_of("ROBOT_JOG")).bEnable);
    await command("let-go");
    await page.close();
  },

  async "The arm follows a hand, a point is marked, and a job is written of the path"() {
    const page = await open();
    // A busy browser may lose the switch: then the page says so, and is started again.
    for (const end = Date.now() + 120_000; ;) {
      check(Date.now() < end, `it cannot be guided: ${await say(page)}`);
      await press(page, "Start guiding");
      await until("neither guided nor refused", async () => /Push the arm|has ended/.test(await say(page)));
      if (!/Push the arm/.test(await say(page))) continue;
      const from = (await value_of("ROBOT_ARM")).position[1];
      await command("push");
      await until("the arm does not follow", async () => (await value_of("ROBOT_ARM")).position[1] - from > 60 || !/Push the arm/.test(await say(page)));
      await command("let-go");
      if (/Push the arm/.test(await say(page))) break;
    }
    await press(page, "Mark a point");
    await until("no point is marked", async () => /Marked points\s+1/.test(await say(page)));
    await browser.check_view(page, "guide-wide");
    await stop(page);
    await until("it is still guided", async () => !(await value_of("ROBOT_ARM")).bGuided);
    await sees(page, "Recorded path");
    await name_job(page, "swing");
    await press(page, "Write the job");
    await sees(page, "swing.job: it was not written by guiding, and is kept; choose another name");
    await name_job(page, "seam");
    await press(page, "Write the job");
    await sees(page, "The robot does not read this file yet");
    check((await say(page)).includes("/seam.job, "), await say(page));
    await browser.check_view(page, "guide-written");
    await page.setViewport({ width: 390, height: 844 });
    await page.evaluate((panel) => document.querySelector(panel).scrollIntoView(), PANEL);
    await browser.check_view(page, "guide-written-phone");
    await page.close();
    const audit = (await (await fetch(`${origin}/api/v1/audit`)).json()).audit.map(({ action }) => action);
    for (const action of ["jog", "end of jog", "write guided path"]) check(audit.includes(action), `no entry of ${action}: ${audit}`);
  },

  // ISO 9241-171: a key that is held down by accident, or by a hand that trembles, acts once.
  async "A button acts once while Enter is held down"() {
    const page = await open();
    const held = async (button, value, name) => {
      await page.focus(button);
      const seen = [];
      for (const end = Date.now() + 2000; Date.now() < end;) {
        await page.keyboard.down("Enter");  // from the second time on a repetition
        seen.push(Number(await value()));
      }
      await page.keyboard.up("Enter");
      // A busy browser may lose the switch: then it stays released.
      const rises = seen.filter((one, i) => one && !seen[i - 1]).length;
      check(rises === 1, `${name}: ${seen.join(" ")}`);
    };
    const hold = "section[aria-label=Jogging] button[aria-pressed]";
    await held(hold, () => value_of("ROBOT_HOLD"), "ROBOT_HOLD");
    await page.$eval(hold, (button) => button.click());
    await until("it is still held", async () => Number(await value_of("ROBOT_HOLD")) === 0);
    await held(`${PANEL} .bar button`, async () => (await value_of("ROBOT_JOG")).bEnable, "ROBOT_JOG.bEnable");
    await page.close({ runBeforeUnload: false });
    await until("the switch is not released", async () => !(await value_of("ROBOT_JOG")).bEnable);
  },

  async "Guiding ends with the page"() {
    const page = await open();
    await press(page, "Start guiding");
    await until("the switch is not pressed", async () => (await value_of("ROBOT_JOG")).bEnable);
    await page.close({ runBeforeUnload: false });
    await until("the switch is not released", async () => !(await value_of("ROBOT_JOG")).bEnable);
  },

  async "Frames, a pallet, a belt that moves and the tracked part are drawn"() {
    const page = await browser.open("robot", WIDE);
    await page.waitForSelector(".arm canvas[data-drawn]");
    await command("fill");
    await sees(page, "Pallet P1: 5 of 12 places used");
    await page.waitForSelector(".arm canvas[data-used='5']");
    await browser.check_view(page, "belt-wide");
    await command("track");
    await page.waitForSelector(".arm canvas[data-tracked='true']");
    await browser.check_view(page, "belt-tracked");
    await press(page, "Frames");
    await page.waitForSelector(".arm canvas[data-frames='false']");
    await page.close();
    const phone = await browser.open("robot", PHONE);
    await phone.waitForSelector(".arm canvas[data-drawn]");
    await browser.check_view(phone, "belt-phone");
    await phone.close();
  },
});

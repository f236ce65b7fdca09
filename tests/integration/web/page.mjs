// SPDX-License-Identifier: Apache-2.0
// Goes through the page as run.py describes; its own argument is the node's name.
import { Browser, check, fill, more, command, origin, press, sees, sees_no } from "./browser.mjs";

const [node] = more;
const SCREENS = {
  wide: { width: 1920, height: 1080 },
  phone: { width: 390, height: 844, dark: true },
  wall: { width: 3840, height: 2160, dark: true },
};
const { wide, phone } = SCREENS;
const JOINTS = [0, 1, 2].map((i) => `PLC_ROBOT::ROBOT_ARM.joint[${i}]`).join();
const RUNS = ["ROBOT_JOB_RUNS", "ROBOT_JOB_WAITS"];
const OVERRIDE = "PLC_ROBOT::ROBOT_OVERRIDE";

const browser = await Browser.launch();
const value_of = async (name) => (await (await fetch(`${origin}/api/v1/boards/${node}/variables/${encodeURIComponent(name)}`)).json()).value;

// The arm is drawn, not only its canvas: the picture has many colours, among them the arm's blue. Without WebGL the page reports
// that it cannot draw; the numbers are shown in any case.
async function is_drawn(page) {
  await page.waitForFunction(() => {
    const canvas = document.querySelector(".arm canvas[data-drawn]");
    if (!canvas) return !!document.querySelector(".robot .warn");
    const copy = Object.assign(document.createElement("canvas"), { width: 200, height: 200 });
    const context = copy.getContext("2d", { willReadFrequently: true });
    context.drawImage(canvas, 0, 0, 200, 200);
    const { data } = context.getImageData(0, 0, 200, 200);
    const colours = new Set();
    let blue = 0;
    for (let i = 0; i < data.length; i += 4) {
      colours.add((data[i] << 16) | (data[i + 1] << 8) | data[i + 2]);
      if (data[i + 2] > data[i] + 60) blue++;
    }
    return colours.size > 50 && blue > 100;
  });
}

// What the page loads before it shows the overview: files, bytes on the wire, and requests.
async function cost_of(page) {
  return await page.evaluate(() => {
    const all = performance.getEntriesByType("resource").map(({ name, transferSize }) => ({ name: new URL(name).pathname, bytes: transferSize }));
    const files = all.filter(({ name }) => !name.startsWith("/api/"));
    return { files: files.length, bytes: files.reduce((sum, { bytes }) => sum + bytes, 0), requests: all.length - files.length };
  });
}

await browser.run({
  async "The overview shows what is running"() {
    for (const [screen, size] of Object.entries(SCREENS)) {
      const began = Date.now();
      const page = await browser.open("overview", size);
      await sees(page, node);
      if (screen === "wide") {
        const { files, bytes, requests } = await cost_of(page);
        console.log(`usable after ${Date.now() - began} ms, ${files} files, ${bytes} bytes, ${requests} requests`);
        check(files <= 10 && bytes < 90_000, `the first view needs ${files} files and ${bytes} bytes`);
      }
      for (const text of ["Robot", "every 10 ms", "Lost ticks", "running"]) await sees(page, text);
      await browser.check_view(page, `overview-${screen}`);
      await page.close();
    }
  },

  async "The token leaves the address"() {
    const page = await browser.open("overview");
    await sees(page, "writing as tester");
    check(!page.url().includes("token"), page.url());
    await page.close();
  },

  async "Without a token nothing can be written"() {
    const page = await browser.open(`variables?v=${OVERRIDE}`, { token: false });
    await sees(page, "read-only");
    await sees(page, "This page is read-only. To write, open the address that the server prints.");
    check(await page.$("form.write") === null, "there is a form to write");
    await page.close();
  },

  async "Variables are found, set within their range, forced and released"() {
    const page = await browser.open("variables");
    await fill(page, "Search variables", "override");
    await sees(page, " of ");
    await page.locator("::-p-xpath(//*[@role='row'][contains(., 'ROBOT_OVERRIDE')])").click();
    await sees(page, "how fast the robot follows its path");
    await sees(page, "0 to 100 %");
    const field = `New value of ${OVERRIDE}`;
    await page.waitForFunction((label) => document.querySelector(`[aria-label='${label}']`)?.value === "100", {}, field);
    await fill(page, field, "500");
    await press(page, "Set");
    await sees(page, "Outside of the range");
    check(await value_of(OVERRIDE) === 100, "a value out of its range was written");
    await fill(page, field, "75");
    await press(page, "Set");
    await sees(page, "Set to 75.");
    check(await value_of(OVERRIDE) === 75, "what was set did not arrive");
    await fill(page, field, "60");
    await page.select("[aria-label='How long to force']", "2");
    await press(page, "Force");
    await sees(page, "1 value is forced");
    await sees(page, "Forced to 60 for 10 min.");
    await browser.check_view(page, "variables-forced-wide");
    await press(page, "Release");
    await sees_no(page, "1 value is forced");
    await fill(page, field, "100");
    await press(page, "Set");
    await sees(page, "Set to 100.");
    await page.close();
  },

  async "A force has a user and a reason, ends with its page, and can force a struct as text"() {
    const page = await browser.open("variables?v=PLC_ROBOT::ROBOT_JOG");
    await fill(page, "New value of PLC_ROBOT::ROBOT_JOG", "{eFrame: 1, bEnable: 0}");
    await fill(page, "Reason, for the audit log", "the pendant is broken");
    await page.select("[aria-label='How long to force']", "4");
    await press(page, "Force");
    await sees(page, "2 values are forced");
    await sees(page, "while the page that forced it is open, by tester");
    await sees(page, "the pendant is broken");
    await new Promise((done) => setTimeout(done, 7000));  // longer than the lease without a renewal
    await sees(page, "2 values are forced");
    await browser.check_view(page, "variables-lease-wide");
    const other = await browser.open("variables");
    await sees(other, "2 values are forced");
    await page.close();
    await sees_no(other, "values are forced");
    await other.close();
  },

  async "A locked board cannot be written until it is unlocked"() {
    const page = await browser.open(`variables?v=${OVERRIDE}`, phone);
    await page.waitForSelector(".lock select");
    await page.select(".lock select", "all");
    await sees(page, "by tester");
    await page.waitForFunction(() => document.querySelector("form.write input").value !== "");  // the current value
    await press(page, "Set");
    await sees(page, "its write lock is 'all' by tester: nothing may be written");
    await browser.check_view(page, "variables-locked-phone");
    await page.select(".lock select", "none");
    await page.waitForFunction(() => document.querySelector(".lock select").value === "none" && !document.querySelector(".lock span"));
    await press(page, "Set");
    await sees(page, "Set to 100.");
    await page.close();
  },

  async "The tree can be used with the keyboard"() {
    const page = await browser.open("variables", SCREENS.phone);
    await sees(page, "PLC_ROBOT");
    await page.focus("[role=treegrid]");
    for (const key of ["Home", "ArrowDown", "ArrowRight"]) await page.keyboard.press(key);
    await sees(page, "emergency_stop");
    await browser.check_view(page, "variables-phone");
    await page.keyboard.press("Enter");
    await sees(page, "The panel, for operation by hand");
    await page.close();
  },

  async "Charts show numbers over time, can be paused, and are restored from the address"() {
    await command("start-tour");
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open(`plots?c=${JOINTS}&c=PLC_ROBOT::ROBOT_ARM.tool_speed&w=10`, size);
      await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 2);
      await page.waitForFunction(() => /^-?[\d.]+$/.test(document.querySelector(".legend .number")?.textContent ?? ""));
      if (screen === "wide") await new Promise((done) => setTimeout(done, 6000));  // so that the picture shows motion
      await press(page, "Pause");
      await sees(page, "Paused");
      await browser.check_view(page, `plots-${screen}`);
      await page.reload();
      await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 2);
      await page.close();
    }
  },

  async "Charts show every tick around a trigger"() {
    await command("start-tour");
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open(`plots?m=single&t=PLC_ROBOT::ROBOT_ARM.tool_speed > 50&pre=40&post=80&c=${JOINTS}&c=PLC_ROBOT::ROBOT_ARM.tool_speed`, size);
      await sees(page, "40 ticks before, 80 after, every 10 ms");
      await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 2);
      await page.waitForFunction(() => /^-?[\d.]+$/.test(document.querySelector(".legend .number")?.textContent ?? ""));
      await browser.check_view(page, `plots-triggered-${screen}`);
      if (screen === "wide") {
        await fill(page, "Expression", "far = abs(PLC_ROBOT::ROBOT_ARM.joint[0] - PLC_ROBOT::ROBOT_ARM.joint[1])");
        await page.keyboard.press("Enter");
        await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 3);
        await page.waitForFunction(() => [...document.querySelectorAll(".legend tr")].some((row) =>
          row.innerText.includes("far") && row.querySelector(".unit").innerText === "deg" && /^[\d.]+$/.test(row.querySelector(".number").innerText)));
        await browser.check_view(page, "plots-expression-wide");
        await fill(page, "Expression", "PLC_ROBOT::ROBOT_ARM.joint[0] + PLC_ROBOT::ROBOT_ARM.tool_speed");
        await page.keyboard.press("Enter");
        await sees(page, "mm/s");
        await press(page, "PLC_ROBOT::ROBOT_ARM.joint[0] + PLC_ROBOT::ROBOT_ARM.tool_speed \u00d7");
        await fill(page, "Trigger", "missing > 1");
        await page.keyboard.press("Enter");
        await sees(page, "no variable 'missing'");
      }
      await page.close();
    }
  },

  async "What is typed as a trigger stays while the charts change"() {
    await command("start-tour");
    const page = await browser.open(`plots?m=auto&t=PLC_ROBOT::ROBOT_ARM.tool_speed > 50&pre=40&post=80&c=${JOINTS}`, wide);
    const tick = () => /tick \d+/.exec(document.querySelector("p.quiet[role=status]").innerText)?.[0];
    await sees(page, "tick ");
    for (const [i, text] of ["mis", "sing", " > 1"].entries()) {
      const before = await page.evaluate(tick);
      if (i === 0) await fill(page, "Trigger", text); else await page.keyboard.type(text);
      await page.waitForFunction(`(${tick})() !== ${JSON.stringify(before)}`);
    }
    await page.keyboard.press("Enter");
    await sees(page, "no variable 'missing'");
    await page.close();
  },

  async "Charts show a recording"() {
    await command("start-tour");
    await command("record");
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open(`plots?m=recording&r=run.mcap&c=${JOINTS}&c=PLC_ROBOT::ROBOT_ARM.tool_speed`, size);
      await sees(page, "run.mcap");
      await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 2);
      await page.waitForFunction(() => /^-?[\d.]+$/.test(document.querySelector(".legend .number")?.textContent ?? ""));
      await browser.check_view(page, `plots-recording-${screen}`);
      await page.close();
    }
  },

  async "A recording is stepped through, back and forward, with what modules kept"() {
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open(`plots?m=recording&r=run.mcap&c=${JOINTS}`, size);
      await page.waitForFunction(() => document.querySelectorAll(".plot canvas").length === 1);
      await press(page, "Step");
      const tick = () => page.evaluate(() => Number(document.querySelector(".step input")?.value));
      const differs_from = (before) => page.waitForFunction((was) => {
        const now = document.querySelector(".step input")?.value;
        return now !== "" && now !== undefined && Number(now) !== was;
      }, {}, before);
      await differs_from(NaN);
      const last = await tick();
      await press(page, "Step back");
      await differs_from(last);
      const earlier = await tick();
      check(earlier < last, `${earlier} is not before ${last}`);
      await sees(page, `What modules kept after tick ${earlier}`);
      for (const text of ["main keeps", "BOOL", "bit for bit", `tick ${earlier}`]) await sees(page, text);
      await browser.check_view(page, `plots-step-${screen}`);
      await press(page, "Step forward");
      await differs_from(earlier);
      check(await tick() === last, `${await tick()} instead of ${last}`);
      await page.focus(".step");
      await page.keyboard.press("ArrowLeft");
      await differs_from(last);
      check(await tick() === earlier, `${await tick()} instead of ${earlier}`);
      await page.reload();  // the address names the tick
      await differs_from(NaN);
      check(await tick() === earlier, `${await tick()} instead of ${earlier} after a reload`);
      await press(page, "Close");
      await sees_no(page, "Step forward");
      await page.close();
    }
  },

  async "The schedule shows runs and explains them"() {
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open("schedule?m=Robot", size);
      await page.waitForSelector(".run rect");
      await sees(page, "Robot: distribution of its times");
      await sees(page, "half below");
      await page.locator("details.panel summary").click();
      await page.$eval("details.panel tbody .link-button", (button) => button.scrollIntoView({ block: "center" }));
      await page.locator("details.panel tbody .link-button").click();
      await sees(page, "after its release");
      await browser.check_view(page, `schedule-${screen}`);
      await page.close();
    }
  },

  async "The robot is drawn, and its numbers are shown"() {
    await command("start-tour");
    for (const [screen, size] of Object.entries({ wide, phone })) {
      const page = await browser.open("robot", size);
      await sees(page, "Commanded");
      await sees(page, "mm/s");
      await sees(page, "cell_arm");
      await is_drawn(page);
      const drawn = (what, value) => page.waitForFunction((name, wanted) => {
        const canvas = document.querySelector(".arm canvas");
        return !canvas || wanted.includes(canvas.dataset[name]);  // without WebGL
      }, {}, what, value);
      await drawn("ways", ["1", "2", "3"]);
      await sees(page, "Planned path: 0");
      await press(page, "Zones");
      await drawn("zones", ["false"]);
      await press(page, "Zones");
      await drawn("zones", ["true"]);
      if (screen === "wide") await new Promise((done) => setTimeout(done, 4000));  // so that the picture shows the path of the tool
      await browser.check_view(page, `robot-${screen}`);
      await page.close();
    }
  },

  async "The buttons for override, hold and stop act on the robot"() {
    await command("start-tour");
    const page = await browser.open("robot", { width: 1280, height: 900 });
    const until = async (what, condition) => {
      for (const end = Date.now() + 60_000; !(await condition());) {
        check(Date.now() < end, what);
        await new Promise((done) => setTimeout(done, 20));
      }
    };
    const arm = async () => await value_of("PLC_ROBOT::ROBOT_ARM");
    const job = async () => (await value_of("PLC_ROBOT::ROBOT_JOB")).eState;
    const moves = async () => (await arm()).tool_speed > 1;
    await sees(page, "Jogging");
    await sees(page, "Tool, frame pallet");
    await until("the robot does not move", moves);
    const override = "::-p-xpath(//section[@aria-label='Jogging']//label[starts-with(., 'Override')]/input)";
    const before = await value_of(OVERRIDE);
    await page.waitForFunction((wanted) => document.querySelector("[aria-label='Jogging'] input").value === String(wanted), {}, before);
    await (await page.waitForSelector(override)).focus();
    await page.keyboard.press("ArrowLeft");
    await until("the override is not set", async () => await value_of(OVERRIDE) === before - 5);
    await sees(page, `Override ${before - 5} %.`);
    await page.keyboard.press("ArrowRight");
    await until("the override is not set back", async () => await value_of(OVERRIDE) === before);
    await until("the robot does not move any more", moves);
    await press(page, "Hold");
    await sees(page, "Held.");
    await until("it is not held", async () => !!(await value_of("PLC_ROBOT::ROBOT_HOLD")) && !(await moves()));
    await sees(page, "Resume");
    await browser.check_view(page, "robot-held");
    await press(page, "Resume");
    await sees(page, "Resumed.");
    await until("it does not resume", async () => !(await value_of("PLC_ROBOT::ROBOT_HOLD")) && await moves());
    await press(page, "Stop");
    await sees(page, "Stopped.");
    await until("it is not stopped", async () => !(await moves()) && !RUNS.includes(await job()));
    await page.close();
  },

  async "The ladder of the cell is shown, wide and on a phone"() {
    await command("start-tour");
    for (const [screen, size] of Object.entries({ wide: { width: 1280, height: 900 }, phone, dark: { width: 1280, height: 900, dark: true } })) {
      const page = await browser.open("plc", size);
      await sees(page, "The drives have no power");
      await page.waitForFunction(() => document.querySelectorAll(".network .power").length > 20);
      check(await page.$eval(".network", (one) => one.querySelectorAll("a[aria-label^='PLC_ROBOT::I14,']").length) > 0, "the emergency stop circuit has no link to its variable");
      if (screen === "phone") check(await page.$eval(".coils .chip", (chip) => chip.innerText.startsWith("safe ")), "the coil is not shown as text");
      await browser.check_view(page, `plc-cell-${screen}`);
      await page.close();
    }
  },

  async "The alarms of the cell are shown"() {
    await command("start-tour");
    for (const [screen, size] of Object.entries({ wide: { width: 1280, height: 800 }, phone })) {
      const page = await browser.open("alarms", size);
      await sees(page, "is in the light curtain");
      await browser.check_view(page, `alarms-cell-${screen}`);
      await page.close();
    }
  },

  async "A module is stopped only after a confirmation, and every view reports it as stopped"() {
    await command("stop-node");  // an earlier test stopped its job
    await command("start-node");
    await command("start-tour");
    const page = await browser.open("overview", { width: 1280, height: 900 });
    await sees(page, "estop");
    const dialog = "dialog[open]";
    const ask = async (label) => {
      await page.locator(`::-p-aria(${label})`).click();
      await page.waitForSelector(dialog);
    };
    const state_of = async (name) => (await (await fetch(`${origin}/api/v1/boards/${node}/modules`)).json()).modules.find((one) => one.name === name).state;
    await ask("Stop estop");
    await sees(page, "estop is the emergency stop: it writes PLC_ROBOT::EMERGENCY_STOP");
    await browser.check_view(page, "stop-asked");
    await press(page, "Leave it running");
    await page.waitForFunction((open) => !document.querySelector(open), {}, dialog);
    check(await state_of("estop") === "running", "it was stopped without a confirmation");
    await ask("Restart main");
    await page.keyboard.press("Escape");
    await page.waitForFunction((open) => !document.querySelector(open), {}, dialog);
    for (const end = Date.now() + 60_000; !RUNS.includes((await value_of("PLC_ROBOT::ROBOT_JOB")).eState);) {
      check(Date.now() < end, "no job runs");
      await new Promise((done) => setTimeout(done, 20));
    }
    await ask("Stop Robot");
    await sees(page, "The robot is in the middle of a job: ");
    await press(page, "Stop Robot");
    await sees(page, `${node}: module Robot is stopped`);
    check(await state_of("Robot") === "stopped", "it was not stopped");
    await browser.check_view(page, "module-stopped");
    const robot = await browser.open("robot", { width: 1280, height: 900 });
    await sees(robot, "Module Robot is stopped: the robot cannot be jogged. Start it on the overview.");
    await sees(robot, "not running");
    await sees_no(robot, "moving");
    await robot.waitForFunction(() => {  // all buttons are disabled
      const all = [...document.querySelectorAll(".jog")];
      return all.length > 0 && all.every((one) => one.matches(":disabled"));
    });
    await browser.check_view(robot, "robot-stopped");
    await page.bringToFront();  // a hidden page sends no requests
    await page.evaluate(() => { location.hash = "#/alarms"; });
    await sees(page, "module Robot is stopped");
    await sees(page, "active, not acknowledged");
    await page.evaluate(() => { location.hash = "#/overview"; });
    await page.locator("::-p-aria(Start Robot)").click();
    await sees_no(page, "module Robot is stopped");
    await robot.bringToFront();
    await sees_no(robot, "the robot cannot be jogged");
    await robot.close();
    await page.close();
  },

  async "The robot is jogged while a button is held down, and stops when the pointer, the page or the server is lost"() {
    const arm = async () => await value_of("PLC_ROBOT::ROBOT_ARM");
    const jog = async () => await value_of("PLC_ROBOT::ROBOT_JOG");
    const moves = async () => (await arm()).tool_speed > 1;
    const until = async (what, condition) => {
      for (const end = Date.now() + 30_000; !(await condition());) {
        check(Date.now() < end, `${what}: ${JSON.stringify(await jog())}`);
        await new Promise((done) => setTimeout(done, 20));
      }
    };
    await command("power-on");
    const page = await browser.open("robot", { width: 1280, height: 900 });
    await sees(page, "standby");
    const centre = async (on, label) => {
      const box = await (await on.waitForSelector(`[aria-label='${label}']`)).boundingBox();
      return [box.x + box.width / 2, box.y + box.height / 2];
    };
    await page.select("section[aria-label='Jogging'] select", "base");
    await sees(page, "roll");
    const z = await centre(page, "z forward, while held down");
    const from = (await arm()).position[2];
    // If a busy browser does not renew its request in time, the server releases the switch: then the button is pressed again.
    // Such a motion may be shorter than the time between two polls, so the position counts, too.
    const starts_to_move = async (down) => {
      const before = (await arm()).position;
      await down();
      for (const soon = Date.now() + 1500; Date.now() < soon;) {
        const { tool_speed, position } = await arm();
        if (tool_speed > 1 || position.some((value, i) => Math.abs(value - before[i]) > 0.1)) return true;
      }
      return false;
    };
    const press_until_it_moves = async () => {
      for (const end = Date.now() + 60_000; ;) {
        await page.mouse.move(...z);
        if (await starts_to_move(() => page.mouse.down())) return;
        await page.mouse.up();
        check(Date.now() < end, `it does not move: ${JSON.stringify(await jog())}`);
      }
    };
    const shown = () => page.$$eval(".facts dt", (all) => parseFloat(all.find((one) => one.innerText === "Tool z").nextElementSibling.innerText));
    const shown_before = await shown();
    await press_until_it_moves();
    await until("the page does not show it moving", async () => {
      if (!(await moves())) {
        await page.mouse.up();
        await press_until_it_moves();
      }
      return await shown() > shown_before;
    });
    check((await jog()).dSpeed[2] === 10, "the speed is not the one that the page shows");
    await page.mouse.up();
    await until("it does not stop", async () => !(await moves()) && !(await jog()).bEnable);
    check((await arm()).position[2] > from, "it moved in another direction");
    await browser.check_view(page, "robot-jog-wide");
    // The pointer leaves the button, another window gets the focus, the page is closed.
    const losses = {
      "the pointer leaves": () => page.mouse.move(5, 5),
      "the window is left": () => page.evaluate(() => window.dispatchEvent(new Event("blur"))),
    };
    for (const [what, act] of Object.entries(losses)) {
      await press_until_it_moves();
      await act();
      await until(`the robot does not stop after ${what}`, async () => !(await moves()) && !(await jog()).bEnable);
      await page.mouse.up();
    }
    await press_until_it_moves();
    await page.mouse.up();
    // A network that answers no renewal: the browser must not keep requests that would still move the robot after the release.
    const open = new Set();  // without those that were sent before and end now
    let most = 0;
    let stalled = true;
    await page.setRequestInterception(true);
    page.on("request", (request) => {
      if (!stalled || !request.url().endsWith("/keep")) return void request.continue().catch(() => undefined);
      open.add(request);
      most = Math.max(most, open.size);
    });
    page.on("requestfailed", (request) => open.delete(request));
    await until("no renewal is sent", async () => {
      await page.mouse.move(...z);
      await page.mouse.down();
      await new Promise((done) => setTimeout(done, 1000));
      const sent = open.size > 0;
      if (!sent) await page.mouse.up();
      return sent;
    });
    await new Promise((done) => setTimeout(done, 1500));
    await page.mouse.up();
    await until("requests of a button that was released are still open", () => open.size === 0);
    check(most <= 3, `${most} renewals are open at a time`);
    stalled = false;
    await press_until_it_moves();
    await page.close({ runBeforeUnload: false });
    await until("the robot does not stop after the page was closed", async () => !(await moves()) && !(await jog()).bEnable);
    const other = await browser.open("robot", phone);
    await sees(other, "standby");
    await is_drawn(other);
    await other.evaluate(() => document.querySelector("[aria-label='Jogging']").scrollIntoView());
    await browser.check_view(other, "robot-jog-phone");
    const button = await other.waitForSelector("[aria-label$='back, while held down']");
    await button.focus();
    for (const end = Date.now() + 60_000; ;) {
      await other.keyboard.up("Space");
      if (await starts_to_move(() => other.keyboard.down("Space"))) break;
      check(Date.now() < end, "no motion by the keyboard");
    }
    await command("kill-server");
    // The killed server cannot release the switch; the robot task sees that its beat no longer counts.
    await command("start-server");
    await until("the robot does not stop after the server was killed", async () => !(await moves()));
    await sees(other, "Jogging");
    await command("automatic");
    await sees(other, "Automatic mode: the robot cannot be jogged.");
    await other.close();
  },

  async "The page reports a stopped server and a stopped node, and resumes when they are back"() {
    const page = await browser.open("overview");
    await sees(page, "connected");
    await command("stop-server");
    await sees(page, "The server cannot be reached.");
    await browser.check_view(page, "server-gone");
    await command("start-server");
    await sees(page, "connected");
    await sees_no(page, "The server cannot be reached");
    await command("stop-node");
    await sees(page, `Node ${node} is not running`);
    await command("start-node");
    await sees_no(page, "is not running");
    await page.close();
  },

  async "Without a node every view says what it is for"() {
    await command("remove-node");
    for (const view of ["overview", "alarms", "variables", "plots", "schedule", "plc", "robot"]) {
      const page = await browser.open(view, phone);
      await sees(page, "No node is running on this host.");
      await sees(page, "This view ");
      await sees_no(page, "Loading");
      await page.close();
    }
    const page = await browser.open("recipes", phone);
    await sees(page, "A recipe is a named set of parameter values");
    await browser.check_view(page, "no-node-phone");
    await page.close();
  },
});

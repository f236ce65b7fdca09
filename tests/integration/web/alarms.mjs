// SPDX-License-Identifier: Apache-2.0
// The page's alarms as alarms.py describes.
import { Browser, check, fill, command, press, sees, sees_no } from "./browser.mjs";

const browser = await Browser.launch();
const wide = { width: 1280, height: 800 };
const phone = { width: 390, height: 844 };

async function sign_in(page, user) {
  await press(page, "Sign in");
  await fill(page, "User", user);
  await fill(page, "Password", "correct horse");
  await Promise.all([page.waitForNavigation(), page.keyboard.press("Enter")]);
  await sees(page, "Sign out");
}

await browser.run({
  async "An alarm is raised, acknowledged and cleared"() {
    const page = await browser.open("alarms", wide);
    await sees(page, "All alarms are normal.");
    await sees(page, "the gripper");  // a message of a module
    await command("press::oil=91.5");
    await sees(page, "active, not acknowledged");
    for (const text of ["the oil is too hot", "press::oil > 80", "91.5", "1 not acknowledged", "high"]) await sees(page, text);
    await fill(page, "Reason", "cooling is on");
    await press(page, "acknowledge");
    await sees(page, "active, acknowledged");
    await sees(page, "by tester: cooling is on");
    await command("press::oil=20");
    await sees(page, "All alarms are normal.");
    await sees(page, "cleared");
    await page.close();
  },

  async "A cleared alarm that was not acknowledged and a shelved one are kept when the server is killed"() {
    const page = await browser.open("alarms", wide);
    await command("press::door_open=true");
    await sees(page, "the door is open");
    await command("press::door_open=false");
    await sees(page, "cleared, not acknowledged");
    await command("press::oil=95");
    await sees(page, "2 not acknowledged");
    await fill(page, "Reason", "sensor is ordered");
    await page.locator("::-p-aria(Shelve press::oil > 80)").click();
    await sees(page, "shelved until");
    await command("kill-server");
    await sees(page, "The server cannot be reached");
    await command("start-server");
    await sees_no(page, "The server cannot be reached");
    await sees(page, "by tester: sensor is ordered");
    await sees(page, "cleared, not acknowledged");
    await browser.check_view(page, "alarms-wide");
    const right = await page.evaluate(() => {
      document.querySelector(".alarms .message").append("w".repeat(300));
      return Math.max(...[...document.querySelectorAll(".alarms .actions button")].map((one) => one.getBoundingClientRect().right));
    });
    check(right > 0 && right < wide.width, `a long text of an alarm moves the buttons to ${right}`);
    await page.close();
  },

  async "A unit leaves room for the name and the value on a phone"() {
    const page = await browser.open("variables", { width: 390, height: 844 });
    const unit = await page.waitForSelector(".line .unit:not(:empty)");
    const widths = await unit.evaluate((one) => {
      one.textContent = "w".repeat(100);
      return [...one.parentElement.children].slice(0, 2).map((cell) => cell.getBoundingClientRect().width);
    });
    check(widths.every((width) => width > 60), `name and value are ${widths} wide`);
    await page.close();
  },

  async "A page without a user does not keep its session alive"() {
    const page = await browser.open("alarms", wide);
    await sees(page, "cleared, not acknowledged");
    const next = async (path) => (await page.waitForRequest((request) => request.url().endsWith(path))).headers()["indurop-background"];
    check(await next("/api/v1/status") === undefined, "its user has just opened it");
    await page.evaluate(() => { const real = Date.now; Date.now = () => real() + 61_000; });
    await next("/api/v1/status");  // it may have been on its way
    check(await next("/api/v1/status") === "true", "its user has not touched it for a minute");
    await page.mouse.move(50, 50);
    await page.mouse.move(60, 60);
    check(await next("/api/v1/status") === undefined, "its user has touched it");
    await page.close();
  },

  async "Alarms are shown on a phone in dark colours, and on the overview"() {
    const page = await browser.open("alarms", { width: 390, height: 844, dark: true });
    await sees(page, "cleared, not acknowledged");
    await browser.check_view(page, "alarms-phone");
    await page.close();
    const overview = await browser.open("overview", wide);
    await sees(overview, "1 alarm is not acknowledged, 1 is shelved");
    await browser.check_view(overview, "alarms-overview");
    await overview.close();
  },

  async "A deployment changes the variables while the page is open"() {
    const page = await browser.open("variables", wide);
    await sees(page, "press");
    await sees_no(page, "many");
    await command("deploy");
    await sees(page, "many");
    await sees_no(page, "is not running");
    await page.close();
  },

  async "Without a token there are no buttons"() {
    const page = await browser.open("alarms", { ...wide, token: false });
    await sees(page, "the door is open");
    await sees_no(page, "Acknowledge all");
    await page.close();
  },

  async "A server that was restarted with another token can be reached"() {
    const page = await browser.open("alarms", wide);
    await sees(page, "writing as tester");
    await command("kill-server");
    await sees(page, "The server cannot be reached");
    await command("other-token");
    await command("start-server");
    await sees(page, "The server does not know the token of this page");
    await sees(page, "The page is read-only");
    await sees(page, "connected, read-only");
    await sees_no(page, "The server cannot be reached");
    await sees_no(page, "Acknowledge all");
    await browser.check_view(page, "other-token");
    await page.evaluate(() => { location.hash = "#token=the-next-token-of-this-server-0123456789"; });
    await sees(page, "writing as tester");
    await sees_no(page, "does not know the token");
    await page.close();
  },

  async "Users sign in, do what their role permits, and sign out"() {
    await command("kill-server");
    await command("users");
    await command("start-server");
    const page = await browser.open("alarms", { ...phone, token: false });
    await sees(page, "the door is open");
    await sees_no(page, "Acknowledge all");
    await press(page, "Sign in");
    await fill(page, "User", "anna");
    await fill(page, "Password", "wrong horse");
    await browser.check_view(page, "sign-in");
    await page.keyboard.press("Enter");
    await sees(page, "the user or the password is wrong");
    await fill(page, "Password", "correct horse");
    await Promise.all([page.waitForNavigation(), page.keyboard.press("Enter")]);
    await sees(page, "Acknowledge all");
    await sees(page, "Sign out");
    await browser.check_view(page, "signed-in");
    await Promise.all([page.waitForNavigation(), press(page, "Sign out")]);
    await sees_no(page, "Acknowledge all");
    await sign_in(page, "eve");
    await sees_no(page, "Acknowledge all");
    await page.close();
  },

  async "An administrator sees the users, their sessions and the audit log, and ends sessions"() {
    const anna = await browser.open("alarms", { ...wide, token: false });
    await sign_in(anna, "anna");
    const page = await browser.open("audit", { ...wide, token: false });
    await sees(page, "sensor is ordered");  // of the alarm that was shelved
    await sees_no(page, "Signs in with");
    await sign_in(page, "ida");
    for (const text of ["Signs in with", "operate", "from 127.0.0.1", "wrong user or password, as 'anna'"]) await sees(page, text);
    await browser.check_view(page, "audit-wide");
    await fill(page, "Filter", "shelve");
    await sees_no(page, "wrong user or password");
    await page.locator("::-p-aria(End the sessions of anna)").click();
    await sees(page, "anna: 1 session ended.");
    await anna.bringToFront();  // a hidden page asks for nothing
    await sees(anna, "the session has ended");
    await page.bringToFront();
    await fill(page, "Filter", "end sessions");
    await sees(page, "1 ended");
    await page.setViewport({ ...phone, isMobile: true, hasTouch: true });
    await browser.check_view(page, "audit-phone");
    await anna.close();
    await page.close();
  },

  async "A user who is removed is signed out"() {
    const page = await browser.open("alarms", { ...wide, token: false });
    await sign_in(page, "anna");
    await sees(page, "writing as anna");
    await command("remove-anna");
    await sees(page, "the session has ended");
    await sees_no(page, "Acknowledge all");
    await page.close();
  },
});

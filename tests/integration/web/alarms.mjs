// SPDX-License-Identifier: Apache-2.0
// The page's alarms as alarms.py says.
import { Browser, fill, order, press, sees, sees_no } from "./browser.mjs";

const browser = await Browser.launch();
const wide = { width: 1280, height: 800 };

await browser.run({
  async "An alarm comes, is acknowledged, and goes"() {
    const page = await browser.open("alarms", wide);
    await sees(page, "All alarms are normal.");
    await sees(page, "the gripper");  // a message of a module
    await order("press::oil=91.5");
    await sees(page, "active, not acknowledged");
    for (const text of ["the oil is too hot", "press::oil > 80", "91.5", "1 not acknowledged", "high"]) await sees(page, text);
    await fill(page, "Reason", "cooling is on");
    await press(page, "acknowledge");
    await sees(page, "active, acknowledged");
    await sees(page, "by tester: cooling is on");
    await order("press::oil=20");
    await sees(page, "All alarms are normal.");
    await sees(page, "cleared");
    await page.close();
  },

  async "One that went unseen and a shelved one, after the server was killed"() {
    const page = await browser.open("alarms", wide);
    await order("press::door_open=true");
    await sees(page, "the door is open");
    await order("press::door_open=false");
    await sees(page, "over, not acknowledged");
    await order("press::oil=95");
    await sees(page, "2 not acknowledged");
    await fill(page, "Reason", "sensor is ordered");
    await page.locator("::-p-aria(Shelve press::oil > 80)").click();
    await sees(page, "shelved until");
    await order("kill-server");
    await sees(page, "The server is gone");
    await order("start-server");
    await sees_no(page, "The server is gone");
    await sees(page, "by tester: sensor is ordered");
    await sees(page, "over, not acknowledged");
    await browser.judge(page, "alarms-wide");
    await page.close();
  },

  async "On a phone in the dark, and the overview says so"() {
    const page = await browser.open("alarms", { width: 390, height: 844, dark: true });
    await sees(page, "over, not acknowledged");
    await browser.judge(page, "alarms-phone");
    await page.close();
    const overview = await browser.open("overview", wide);
    await sees(overview, "1 alarm is not acknowledged, 1 is shelved");
    await browser.judge(overview, "alarms-overview");
    await overview.close();
  },

  async "A deployment changes the variables while the page is open"() {
    const page = await browser.open("variables", wide);
    await sees(page, "press");
    await sees_no(page, "many");
    await order("deploy");
    await sees(page, "many");
    await sees_no(page, "is gone");
    await page.close();
  },

  async "Who only looks is offered nothing to press"() {
    const page = await browser.open("alarms", { ...wide, token: false });
    await sees(page, "the door is open");
    await sees_no(page, "Acknowledge all");
    await page.close();
  },

  async "A server that was started again with another token is not gone"() {
    const page = await browser.open("alarms", wide);
    await sees(page, "writing as tester");
    await order("kill-server");
    await sees(page, "The server is gone");
    await order("other-token");
    await order("start-server");
    await sees(page, "The server does not know the token of this page");
    await sees(page, "You only look");
    await sees(page, "connected, only looking");
    await sees_no(page, "The server is gone");
    await sees_no(page, "Acknowledge all");
    await browser.judge(page, "other-token");
    await page.evaluate(() => { location.hash = "#token=the-next-token-of-this-server-0123456789"; });
    await sees(page, "writing as tester");
    await sees_no(page, "does not know the token");
    await page.close();
  },
});

// SPDX-License-Identifier: Apache-2.0
// The overview of a plant as plant.py says; its own word is what the boards' names begin with.
import { Browser, check, fill, more, order, press, sees, sees_no } from "./browser.mjs";

const [boards] = more;
const browser = await Browser.launch();
const missed = (screen, size) => async () => {
  const page = await browser.open("overview", size);
  await sees(page, "all 2 heard");
  await order("kill=right");
  await sees(page, `Board ${boards}_right no longer reports, last `);
  await sees(page, "1 of 2 silent");
  await browser.judge(page, `plant-${screen}`);
  await order("start=right");
  await sees(page, "all 2 heard");
  await sees_no(page, "not heard");
  await page.close();
};

// Ids of what runs now, as the page has them.
const runs_now = (page) => page.$$eval(".deployments .current th", (rows) => rows.map((row) => row.innerText.slice(0, 12)));

await browser.run({
  async "Variables that become others are shown anew"() {
    await order("fake=2");
    const page = await browser.open("variables?q=many", { width: 1280, height: 800 });
    await sees(page, "2 of ");
    await order("fake=5");
    await sees(page, "5 of ");
    await page.waitForFunction(() => [...document.querySelectorAll("[role='row'] .value")].some((one) => Number(one.innerText) > 0));
    await page.close();
  },

  "A killed board is missed in words, and comes back": missed("wide", { width: 1280, height: 720 }),
  "On a phone too": missed("phone", { width: 390, height: 844, dark: true }),

  async "Deployments are shown and compared, and the plant is rolled back"() {
    await order("deploy=2ms");
    const page = await browser.open("deployments", { width: 1280, height: 800 });
    await sees(page, "runs now");
    const [first] = await runs_now(page);
    await order("deploy=4ms");
    await page.waitForFunction((id) => !document.querySelector(".deployments .current th").innerText.startsWith(id), {}, first);
    const [second] = await runs_now(page);
    await sees(page, `From ${first} to ${second}`);
    await sees(page, "1 file differs.");
    await sees(page, "- <period>2ms</period>");
    await sees(page, "+ <period>4ms</period>");
    await browser.judge(page, "deployments-wide");
    const looking = await browser.open("deployments", { width: 390, height: 844, dark: true, token: false });
    await sees(looking, "plant.xml");
    check(await looking.$("[aria-label^='Roll back']") === null, "who may only look is offered to roll back");
    await browser.judge(looking, "deployments-phone");
    await looking.close();
    await (await page.waitForSelector(`[aria-label^='Roll back to ${first}']`)).click();
    await sees(page, `Roll plant ${boards} back to ${first}?`);
    await fill(page, "Reason, for the audit log", "too slow");
    await browser.judge(page, "deployments-confirm");
    await press(page, "Roll back now");
    await sees(page, `${first} runs again on all boards.`);
    await page.waitForFunction((id) => document.querySelector(".deployments .current th").innerText.startsWith(id), {}, first);
    await page.close();
  },
});

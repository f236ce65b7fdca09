// SPDX-License-Identifier: Apache-2.0
// The overview of a plant as plant.py describes; its own argument is the beginning of the boards' names.
import { Browser, check, fill, more, command, press, sees, sees_no } from "./browser.mjs";

const [boards] = more;
const browser = await Browser.launch();
const killed_board = (screen, size) => async () => {
  const page = await browser.open("overview", size);
  await sees(page, "all 2 reporting");
  await command("kill=right");
  await sees(page, `Board ${boards}_right no longer reports, last `);
  await sees(page, "1 of 2 silent");
  await browser.check_view(page, `plant-${screen}`);
  await command("start=right");
  await sees(page, "all 2 reporting");
  await sees_no(page, "silent");
  await page.close();
};

// The id of the running deployment, once the page shows one other than `previous`.
const running_deployment = async (page, previous = "") => (await page.waitForFunction((old) => {
  const id = document.querySelector(".deployments .current th")?.innerText.slice(0, 12);
  return id && id !== old ? id : null;
}, {}, previous)).jsonValue();

await browser.run({
  async "Other variables of a restarted node are shown"() {
    await command("fake=2");
    const page = await browser.open("variables?q=many", { width: 1280, height: 800 });
    await sees(page, "2 of ");
    await command("fake=5");
    await sees(page, "5 of ");
    await page.waitForFunction(() => [...document.querySelectorAll("[role='row'] .value")].some((one) => Number(one.innerText) > 0));
    await page.close();
  },

  "A killed board is reported, and comes back": killed_board("wide", { width: 1280, height: 720 }),
  "A killed board is reported on a phone, too": killed_board("phone", { width: 390, height: 844, dark: true }),

  async "Deployments are shown and compared, and the plant is rolled back"() {
    await command("deploy=2ms");
    const page = await browser.open("deployments", { width: 1280, height: 800 });
    const first = await running_deployment(page);
    await command("deploy=4ms");
    const second = await running_deployment(page, first);
    await sees(page, `From ${first} to ${second}`);
    await sees(page, "1 file differs.");
    await sees(page, "- <period>2ms</period>");
    await sees(page, "+ <period>4ms</period>");
    await browser.check_view(page, "deployments-wide");
    const looking = await browser.open("deployments", { width: 390, height: 844, dark: true, token: false });
    await sees(looking, "plant.xml");
    check(await looking.$("[aria-label^='Roll back']") === null, "a page without a token has a button to roll back");
    await browser.check_view(looking, "deployments-phone");
    await looking.close();
    await (await page.waitForSelector(`[aria-label^='Roll back to ${first}']`)).click();
    await sees(page, `Roll plant ${boards} back to ${first}?`);
    await fill(page, "Reason, for the audit log", "too slow");
    await browser.check_view(page, "deployments-confirm");
    await press(page, "Roll back now");
    await sees(page, `${first} is running on all boards.`);
    check(await running_deployment(page, second) === first, "another deployment is running");
    await page.close();
  },
});

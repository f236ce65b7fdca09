// SPDX-License-Identifier: Apache-2.0
// The overview of a plant as plant.py says; its own word is what the boards' names begin with.
import { Browser, more, order, sees, sees_no } from "./browser.mjs";

const [boards] = more;
const browser = await Browser.launch();
const missed = (screen, size) => async () => {
  const page = await browser.open("overview", size);
  await sees(page, "all 2 heard");
  await order("kill=right");
  await sees(page, `Board ${boards}_right is not heard any more, last `);
  await sees(page, "1 of 2 silent");
  await browser.judge(page, `plant-${screen}`);
  await order("start=right");
  await sees(page, "all 2 heard");
  await sees_no(page, "not heard");
  await page.close();
};

await browser.run({
  "A killed board is missed in words, and comes back": missed("wide", { width: 1280, height: 720 }),
  "On a phone too": missed("phone", { width: 390, height: 844, dark: true }),
});

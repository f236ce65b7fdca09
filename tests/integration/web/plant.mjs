// SPDX-License-Identifier: Apache-2.0
// plant.mjs DRIVER ORIGIN TOKEN BOARDS PICTURES BROWSER: the overview of a plant as plant.py says. Ends with 0 if all was right.
import { Browser, order, sees, sees_no } from "./browser.mjs";

const [driver, origin, token, boards, pictures, program] = process.argv.slice(2);
const browser = await Browser.launch(driver, program, origin, token, pictures);

let failed = 0;
try {
  for (const [screen, size] of Object.entries({ wide: { width: 1280, height: 720 }, phone: { width: 390, height: 844, dark: true } })) {
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
  }
} catch (error) {
  failed++;
  console.log(`FAILED: ${error.message}`);
}
for (const line of browser.said) console.log(`FAILED: the console says: ${line}`);
await browser.close();
process.exit(failed + browser.said.length === 0 ? 0 : 1);

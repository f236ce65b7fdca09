// SPDX-License-Identifier: Apache-2.0
// Answers the questions of a job as question.py describes it; its own argument is the node's name.
import { Browser, check, command, fill, more, origin, press, sees, sees_no } from "./browser.mjs";

const [node] = more;
const WIDE = { width: 1280, height: 900 };
const PHONE = { width: 390, height: 844, dark: true };

const browser = await Browser.launch();
const value_of = async (name) => (await (await fetch(`${origin}/api/v1/boards/${node}/variables/PLC_ROBOT::${name}`)).json()).value;
const until = async (what, condition) => {
  for (const end = Date.now() + 30_000; !(await condition());) {
    check(Date.now() < end, what);
    await new Promise((done) => setTimeout(done, 20));
  }
};

await browser.run({
  async "A choice is answered by its button"() {
    await command("ask");
    const reader = await browser.open("robot", { ...WIDE, token: false });
    await sees(reader, "Which tray has the parts?");
    await sees(reader, "A user who may operate the robot can answer.");
    check(await reader.$(".question button") === null, "a reader can answer");
    await reader.close();
    const page = await browser.open("robot", WIDE);
    await sees(page, "The job asks");
    await sees(page, "Which tray has the parts?");
    await browser.check_view(page, "question-choice");
    await press(page, "right");
    await sees(page, "How many parts are in tray 2?");
    await sees_no(page, "Which tray has the parts?");
    await page.close();
  },

  async "A number is checked and answered"() {
    const page = await browser.open("robot", PHONE);
    await sees(page, "How many parts are in tray 2?");
    await sees(page, "s left to answer.");
    await page.evaluate(() => document.querySelector(".question").scrollIntoView());
    await browser.check_view(page, "question-number-phone");
    const asked = await value_of("ROBOT_QUESTION");
    await fill(page, "Answer", "41");
    await press(page, "Answer");
    const now = await value_of("ROBOT_QUESTION");
    check(now.nNumber === asked.nNumber && now.nAcknowledge === asked.nAcknowledge, "the browser sends a number that is out of range");
    await fill(page, "Answer", "12");
    await press(page, "Answer");
    await sees_no(page, "The job asks");
    await until("the job does not end", async () => (await value_of("ROBOT_JOB")).eState === "ROBOT_JOB_ENDED");
    check(await value_of("O15") === 212, `the job has other answers: ${await value_of("O15")}`);
    await page.close();
  },
});

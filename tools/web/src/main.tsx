// SPDX-License-Identifier: Apache-2.0
// Entry point of the page: lists the views and shows the one that the address names.

import "./style.css";
import "uplot/dist/uPlot.min.css";
import "./views/plots/plots.css";
import "./views/robot/robot.css";
import "./views/alarms/alarms.css";
import "./views/schedule/schedule.css";
import "./views/variables/variables.css";
import "./views/plc/plc.css";
import "./views/deployments/deployments.css";
import "./views/audit/audit.css";
import { render } from "preact";
import { take_token_from_address } from "./api/http";
import { start_polling } from "./shell/plant";
import { Shell, type View } from "./shell/shell";
import { place } from "./ui/address";
import { useStore } from "./ui/store";
import { lazy_view } from "./views/lazy";
import { Overview } from "./views/overview";

const VIEWS: (View & { show: () => preact.JSX.Element | null })[] = [
  { name: "overview", title: "Overview", icon: "M3 3h8v8H3zM13 3h8v5h-8zM13 10h8v11h-8zM3 13h8v8H3z", show: Overview },
  { name: "alarms", title: "Alarms", icon: "M12 2a2 2 0 0 1 2 2 7 7 0 0 1 5 7v5l2 2v1H3v-1l2-2v-5a7 7 0 0 1 5-7 2 2 0 0 1 2-2zM10 20h4a2 2 0 0 1-4 0z", show: lazy_view(() => import("./views/alarms/alarms").then(({ Alarms }) => Alarms)) },
  { name: "variables", title: "Variables", icon: "M4 4h6v4H4zM12 5h8v2h-8zM8 10h6v4H8zM16 11h4v2h-4zM8 16h6v4H8zM16 17h4v2h-4zM5 8h1v11h2v-1H6v-6h2v-1H6V8z", show: lazy_view(() => import("./views/variables/variables").then(({ Variables }) => Variables)) },
  { name: "plots", title: "Plots", icon: "M3 3h2v16h16v2H3zM7 16l4-6 4 3 5-8 1.6 1-6 10-4-3-3 4.5z", show: lazy_view(() => import("./views/plots/plots").then(({ Plots }) => Plots)) },
  { name: "schedule", title: "Schedule", icon: "M3 4h7v4H3zM9 10h9v4H9zM5 16h6v4H5zM14 4h7v4h-7zM15 16h6v4h-6z", show: lazy_view(() => import("./views/schedule/schedule").then(({ Schedule }) => Schedule)) },
  { name: "recipes", title: "Recipes", icon: "M5 3h11l3 3v15H5zM8 8h8v1.6H8zM8 12h8v1.6H8zM8 16h5v1.6H8z", show: lazy_view(() => import("./views/recipes/recipes").then(({ Recipes }) => Recipes)) },
  { name: "deployments", title: "Deployments", icon: "M4 3h6v5H4zM14 16h6v5h-6zM6 9h2v4h8v-2l4 3-4 3v-2H6zM4 17h6v4H4z", show: lazy_view(() => import("./views/deployments/deployments").then(({ Deployments }) => Deployments)) },
  { name: "plc", title: "PLC", icon: "M3 3h2v18H3zM19 3h2v18h-2zM5 11h3V7h2v10H8v-4H5zM19 11h-3V7h-2v10h2v-4h3z", show: lazy_view(() => import("./views/plc/plc").then(({ Plc }) => Plc)) },
  { name: "robot", title: "Robot", icon: "M4 21v-3h3l1-6 6-5a3 3 0 1 1 1.4 1.8L10 13l-.9 5H13v3zM20 9l1.5 3-2.5 4-1.4-1 1.8-3-1-2z", show: lazy_view(() => import("./views/robot/robot").then(({ Robot }) => Robot)) },
  { name: "audit", title: "Audit", icon: "M12 3a4.5 4.5 0 1 1 0 9 4.5 4.5 0 0 1 0-9zM4 21a8 7.5 0 0 1 16 0z", show: lazy_view(() => import("./views/audit/audit").then(({ Audit }) => Audit)) },
];

function Page() {
  const { view } = useStore(place);
  const shown = VIEWS.find(({ name }) => name === view) ?? VIEWS[0];
  return <Shell views={VIEWS} title={shown.title}><shown.show key={shown.name} /></Shell>;
}

take_token_from_address();
// The browser does not reload the page for an address that differs only in its token.
window.addEventListener("hashchange", () => { if (take_token_from_address()) location.reload(); });
// A key that is held down acts once. A browser clicks a button at each repetition of Enter: one whose meaning changes,
// such as Hold and Resume, would let the robot move again.
window.addEventListener("keydown", (event) => { if (event.repeat && event.key === "Enter" && !(event.target instanceof HTMLTextAreaElement)) event.preventDefault(); }, true);
start_polling();
render(<Page />, document.getElementById("page")!);

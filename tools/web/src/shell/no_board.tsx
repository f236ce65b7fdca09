// SPDX-License-Identifier: Apache-2.0
// Shown by a view that has no board to show: what the view is for. The notice above it says how to start a node.

import { Waiting } from "../ui/parts";
import { useStore } from "../ui/store";
import { plant } from "./plant";

export function NoBoard({ purpose }: { purpose: string }) {
  const { boards } = useStore(plant);
  return boards ? <p class="panel quiet">{purpose}</p> : <Waiting />;
}

// SPDX-License-Identifier: Apache-2.0
// Current values of the variables in visible lines, from the stream.

import { useEffect, useRef, useState } from "preact/hooks";
import { stream } from "../../api/stream";
import type { Quality } from "../../api/types";

const RATE_HZ = 5;
const SETTLE_MS = 120;  // while the user scrolls, lines that pass are not subscribed to

export interface Live {
  values: Map<string, unknown>;
  quality: Map<string, Quality>;
  forced: Set<string>;
  rejected: string;
}

export function useLive(board: string, names: string[]): Live {
  const live = useRef<Live>({ values: new Map(), quality: new Map(), forced: new Set(), rejected: "" });
  const [, redraw] = useState(0);
  const key = names.join(",");
  useEffect(() => {
    live.current = { values: new Map(), quality: new Map(), forced: new Set(), rejected: "" };
  }, [board]);
  useEffect(() => {
    if (!board || !key) return;
    let end = () => {};
    const timer = setTimeout(() => {
      end = stream.subscribe({
        board, names: key.split(","), rate_hz: RATE_HZ, binary: false,
        values: (frame) => {
          const now = live.current;
          for (const [name, value] of Object.entries(frame.values)) now.values.set(name, value);
          now.quality = new Map(Object.entries(frame.quality ?? {}));
          now.forced = new Set(frame.forced ?? []);
          now.rejected = "";
          redraw((n) => n + 1);
        },
        rejected: (message) => {
          live.current.rejected = message;
          redraw((n) => n + 1);
        },
      });
    }, SETTLE_MS);
    return () => {
      clearTimeout(timer);
      end();
    };
  }, [board, key]);
  return live.current;
}

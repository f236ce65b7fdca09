// SPDX-License-Identifier: Apache-2.0
// Views that are fetched when somebody goes there, so that the first one is there soon. Their styles are in the page's one file.

import { useEffect, useState } from "preact/hooks";
import { Waiting } from "../ui/parts";

const AGAIN_MS = 2000;

type Show = () => preact.JSX.Element | null;

export function fetched(fetch_view: () => Promise<Show>): Show {
  let view: Show | null = null;
  return function Fetched() {
    const [, came] = useState(0);
    const [missing, miss] = useState(false);
    useEffect(() => {
      let timer = 0;
      const turn = () => void fetch_view().then((it) => { view = it; came(1); }).catch(() => {
        miss(true);
        timer = window.setTimeout(turn, AGAIN_MS);
      });
      if (!view) turn();
      return () => clearTimeout(timer);
    }, []);
    if (view) {
      const View = view;
      return <View />;
    }
    // A server of another release has other files.
    return missing ? <p class="bad">This view cannot be fetched: asking again. If the server was updated, reload the page.</p> : <Waiting />;
  };
}

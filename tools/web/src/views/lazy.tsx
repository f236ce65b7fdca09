// SPDX-License-Identifier: Apache-2.0
// Views that are loaded when they are shown first, so that the page starts fast. Their styles are in the page's style sheet.

import { useEffect, useState } from "preact/hooks";
import { Waiting } from "../ui/parts";

const RETRY_MS = 2000;

type Show = () => preact.JSX.Element | null;

export function lazy_view(load_view: () => Promise<Show>): Show {
  let view: Show | null = null;
  return function Loaded() {
    const [, set_loaded] = useState(false);
    const [missing, set_missing] = useState(false);
    useEffect(() => {
      let timer = 0;
      const load = () => void load_view().then((loaded) => { view = loaded; set_loaded(true); }).catch(() => {
        set_missing(true);
        timer = window.setTimeout(load, RETRY_MS);
      });
      if (!view) load();
      return () => clearTimeout(timer);
    }, []);
    if (view) {
      const View = view;
      return <View />;
    }
    // The files of another release have other names.
    return missing ? <p class="bad">This view cannot be loaded; trying again. If the server was updated, reload the page.</p> : <Waiting />;
  };
}

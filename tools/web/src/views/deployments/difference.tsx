// SPDX-License-Identifier: Apache-2.0
// The differences between two deployments: files, and lines of text files.

import { get } from "../../api/http";
import type { ChangedFile } from "../../api/types";
import { plural } from "../../ui/format";
import { Panel, Waiting } from "../../ui/parts";
import { useRequest } from "../../ui/store";
import { SHOWN_ID } from "../plant";

const TIMEOUT_MS = 60_000;
const SIGN = { added: "+", removed: "-", same: " " };

export function shown_id(id: string): string {
  return id.slice(0, SHOWN_ID);
}

function sizes({ size_before, size_after }: ChangedFile): string {
  if (size_before === null) return `${size_after} bytes`;
  return size_after === null ? `${size_before} bytes` : `${size_before} to ${size_after} bytes`;
}

export function Difference({ before, after }: { before: string; after: string }) {
  const { value, error } = useRequest(`${before} ${after}`, 0,
    () => get<{ files: ChangedFile[] }>(`plant/difference?before=${before}&after=${after}`, TIMEOUT_MS));
  return (
    <Panel title={`From ${shown_id(before)} to ${shown_id(after)}`}>
      {error && <p class="bad">{error}</p>}
      {!value && !error && <Waiting />}
      {value && <p>{value.files.length === 0 ? "The files are the same." : `${plural(value.files.length, "file differs", "files differ")}.`}</p>}
      {value?.files.map((file) => (
        <section key={file.path} class="file" aria-label={file.path}>
          <h3>{file.path} <span class="quiet">{file.change}, {sizes(file)}</span></h3>
          {file.lines.length > 0 && (
            <div class="scroll" tabIndex={0} role="region" aria-label={`Lines of ${file.path}`}>
              <pre>{file.lines.map(({ change, text }, i) => <span key={i} class={`diff ${change}`}>{SIGN[change]} {text}{"\n"}</span>)}</pre>
            </div>)}
        </section>))}
    </Panel>);
}

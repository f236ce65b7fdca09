// SPDX-License-Identifier: Apache-2.0
// A list from which one value is selected.

export function Choice({ label, value, of, unit, choose }: { label: string; value: number | string; of: (number | string)[]; unit?: string; choose: (text: string) => void }) {
  return (
    <label class="choice">{label}{" "}
      <select value={value} onChange={(event) => choose(event.currentTarget.value)}>
        {of.map((one) => <option key={one} value={one}>{one}{unit ? ` ${unit}` : ""}</option>)}
      </select>
    </label>);
}

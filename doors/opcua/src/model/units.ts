// SPDX-License-Identifier: Apache-2.0
// Units as OPC UA names them: by their codes of UNECE recommendation 20, where there is one (OPC 10000-8, 5.6.4.3).

import { EUInformation } from "node-opcua-types";

const UNECE = "http://www.opcfoundation.org/UA/units/un/cefact";
const OWN = "urn:indurop:units";

// symbol: code and name
const CODES: Record<string, [string, string]> = {
  m: ["MTR", "metre"], mm: ["MMT", "millimetre"], cm: ["CMT", "centimetre"], um: ["4H", "micrometre"], km: ["KMT", "kilometre"],
  in: ["INH", "inch"], "m/s": ["MTS", "metre per second"], "mm/s": ["C16", "millimetre per second"],
  "m/min": ["2X", "metre per minute"], "km/h": ["KMH", "kilometre per hour"], "m/s2": ["MSK", "metre per second squared"],
  rad: ["C81", "radian"], deg: ["DD", "degree [unit of angle]"], "rad/s": ["2A", "radian per second"],
  "rad/s2": ["2B", "radian per second squared"], "deg/s": ["E96", "degree per second"], rpm: ["RPM", "revolutions per minute"],
  "1/min": ["C94", "reciprocal minute"], "1/s": ["C97", "reciprocal second"], Hz: ["HTZ", "hertz"], kHz: ["KHZ", "kilohertz"],
  MHz: ["MHZ", "megahertz"], s: ["SEC", "second [unit of time]"], ms: ["C26", "millisecond"], us: ["B98", "microsecond"],
  ns: ["C47", "nanosecond"], min: ["MIN", "minute [unit of time]"], h: ["HUR", "hour"], d: ["DAY", "day"],
  kg: ["KGM", "kilogram"], g: ["GRM", "gram"], mg: ["MGM", "milligram"], t: ["TNE", "tonne (metric ton)"],
  N: ["NEW", "newton"], kN: ["B47", "kilonewton"], Nm: ["NU", "newton metre"], "N.m": ["NU", "newton metre"], "N*m": ["NU", "newton metre"],
  Pa: ["PAL", "pascal"], kPa: ["KPA", "kilopascal"], MPa: ["MPA", "megapascal"], hPa: ["A97", "hectopascal"], bar: ["BAR", "bar [unit of pressure]"],
  mbar: ["MBR", "millibar"], J: ["JOU", "joule"], kJ: ["KJO", "kilojoule"], W: ["WTT", "watt"], kW: ["KWT", "kilowatt"],
  kWh: ["KWH", "kilowatt hour"], Wh: ["WHR", "watt hour"], V: ["VLT", "volt"], mV: ["2Z", "millivolt"], kV: ["KVT", "kilovolt"],
  A: ["AMP", "ampere"], mA: ["4K", "milliampere"], Ohm: ["OHM", "ohm"], F: ["FAR", "farad"], H: ["81", "henry"], T: ["D33", "tesla"],
  K: ["KEL", "kelvin"], degC: ["CEL", "degree Celsius"], C: ["CEL", "degree Celsius"], degF: ["FAH", "degree Fahrenheit"],
  "%": ["P1", "percent"], l: ["LTR", "litre"], L: ["LTR", "litre"], ml: ["MLT", "millilitre"], m2: ["MTK", "square metre"],
  m3: ["MTQ", "cubic metre"], "l/min": ["L2", "litre per minute"], "m3/h": ["MQH", "cubic metre per hour"],
  lm: ["LUM", "lumen"], lx: ["LUX", "lux"], cd: ["CDL", "candela"], "1": ["C62", "one"],
};

function spelling(unit: string): string {
  return unit.replace("°C", "degC").replace("°F", "degF").replace("°", "deg").replace("µ", "u").replace("μ", "u")
    .replace("Ω", "Ohm").replace("²", "2").replace("³", "3").replace("^", "").replace("·", ".");
}

// The code as the number that OPC UA makes of its letters.
function number_of(code: string): number {
  return [...code].reduce((number, letter) => number * 256 + letter.charCodeAt(0), 0);
}

export function unit_of(unit: string): EUInformation {
  const known = CODES[spelling(unit)];
  return new EUInformation({
    namespaceUri: known ? UNECE : OWN,
    unitId: known ? number_of(known[0]) : -1,
    displayName: { text: unit },
    description: { text: known ? known[1] : unit },
  });
}

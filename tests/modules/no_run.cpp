// SPDX-License-Identifier: Apache-2.0
// A library that is no module.
extern "C" int calculate(int value) {
  return value + 1;
}

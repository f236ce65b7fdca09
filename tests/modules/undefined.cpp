// SPDX-License-Identifier: Apache-2.0
// Calls a function that no library it was linked with defines.
extern "C" void function_without_body();

extern "C" void run() {
  function_without_body();
}

// SPDX-License-Identifier: Apache-2.0
// A library that is not found where a program that needs it is copied to.
int lacked(void);
int lacked(void) {
  return 1;
}

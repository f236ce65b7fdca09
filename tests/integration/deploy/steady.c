// SPDX-License-Identifier: Apache-2.0
// Does nothing, well.
void run(void) {}

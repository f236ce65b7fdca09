// SPDX-License-Identifier: Apache-2.0
// Another module that does nothing: another deployment.
int other_counter;
void run(void) { ++other_counter; }

// SPDX-License-Identifier: Apache-2.0
// The smallest thread module: what remains is the scheduler.
#include <indurop/indurop.h>

void on_run() {}

INDUROP_MODULE(run = &::on_run)

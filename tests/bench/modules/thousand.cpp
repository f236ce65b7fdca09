// SPDX-License-Identifier: Apache-2.0
// Changes a thousand variables every millisecond, for `indurop watch '*'` to show.
#include <indurop/generated.h>
#include <indurop/indurop.h>

#include "touch.h"

void on_run() {
  static double n = 0;
  n += 1;
  bench::thousand::touch(n);
}

INDUROP_MODULE(run = &::on_run)

// SPDX-License-Identifier: Apache-2.0
// `indurop`, the one command line of the platform.
#include "tools/cli/command/app.h"
#include "tools/client/process/interrupt.h"

int main(int argc, char** argv) {
  indurop::tools::catch_interrupts();
  return indurop::tools::run_program({argv + (argc > 0 ? 1 : 0), argv + argc});
}

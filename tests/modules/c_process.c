/* SPDX-License-Identifier: Apache-2.0 */
/* A process module in C: adds up what c_thread has written. */
#include <indurop/generated.c.h>

int main(void) {
  if (irp_initPeriodExe() < 0) {
    return 1;
  }
  irp_printf("c_process: %s\n", irp_property_text("name", "nameless"));
  while (irp_waitPeriod()) {
    IRP_SET(nt_process_runs, IRP_GET(nt_process_runs) + 1);
    uint64_t newest = 0;
    for (int i = 0; i < 32; ++i) {
      const uint64_t word = IRP_GET(nt_block, .word[i]);
      newest = word > newest ? word : newest;
    }
    IRP_SET(nt_newest, newest);
  }
  return 0;
}

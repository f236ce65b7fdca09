/* SPDX-License-Identifier: Apache-2.0 */
/* A thread module in C: writes its number of runs, and accesses a word that does not exist when it is told to. */
#include <indurop/generated.c.h>

static int32_t runs = 0;
static int64_t bad_run = 0;

void start(void);
void start(void) {
  bad_run = irp_property_integer("bad_run", -1);
  irp_printf("c_thread: %.1f ms\n", (double)irp_period_ns() / 1e6);
}

void run(void);
void run(void) {
  IRP_SET(nt_output, ++runs);
  const int word = runs == bad_run ? 32 : runs % 32;
  IRP_SET_PART(nt_block, .word[word], irp_tick());
}

void stop(void);
void stop(void) {
  irp_printf("c_thread: %d runs\n", runs);
}

// SPDX-License-Identifier: Apache-2.0
// Prints what the meter has measured, with iceoryx's C interface: nothing of InduRoP.
//   watch_iceoryx_c NODE [COUNT]    default: until Ctrl-C
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include <unistd.h>

#include <iceoryx_binding_c/runtime.h>
#include <iceoryx_binding_c/subscriber.h>
#include <iceoryx_binding_c/types.h>

#include "reading.h"

int main(int argc, char** argv) {
  if (argc < 2) {
    fprintf(stderr, "usage: watch_iceoryx_c NODE [COUNT]\n");
    return 2;
  }
  long left = argc > 2 ? strtol(argv[2], NULL, 10) : -1;
  char name[64];
  snprintf(name, sizeof name, "watch_iceoryx_c-%d", (int)getpid());
  // Without RouDi this waits for a minute and then ends the program.
  iox_runtime_init(name);

  iox_sub_options_t options;
  iox_sub_options_init(&options);
  options.historyRequest = 1;  // the last value comes at once, even if it changed long ago
  iox_sub_storage_t storage;
  iox_sub_t subscriber = iox_sub_init(&storage, "InduRoP", argv[1], "meter::reading", &options);
  const struct timespec pause = {0, 5000000};
  while (left != 0) {
    const void* sample = NULL;  // lent
    if (iox_sub_take_chunk(subscriber, &sample) != ChunkReceiveResult_SUCCESS) {
      nanosleep(&pause, NULL);
      continue;
    }
    const meter_Reading* reading = sample;
    printf("count %" PRIu64 " litres %.1f backwards %" PRId32 " odd %d\n", reading->count, reading->litres,
           reading->backwards, reading->odd);
    fflush(stdout);
    iox_sub_release_chunk(subscriber, sample);
    left -= left > 0 ? 1 : 0;
  }
  iox_sub_deinit(subscriber);
  return 0;
}

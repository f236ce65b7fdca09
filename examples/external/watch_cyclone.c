// SPDX-License-Identifier: Apache-2.0
// Prints the state of the axis, with Cyclone DDS and the types that idlc made of station.idl: nothing of InduRoP.
//   watch_cyclone [DOMAIN [COUNT]]    default: domain 0, until Ctrl-C
#include <dds/dds.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "station.h"

static const char* const kModes[] = {"holding", "moving", "arrived"};

static void print(const station_State* state) {
  printf("cycle %" PRIu64 " position %.3f mm force %.2f %.2f %.2f N mode %s inside %d program '%s'\n", state->cycle,
         state->position, state->force[0], state->force[1], state->force[2], kModes[state->mode], state->inside,
         state->program);
  fflush(stdout);
}

int main(int argc, char** argv) {
  const dds_domainid_t domain = argc > 1 ? (dds_domainid_t)strtoul(argv[1], NULL, 10) : 0;
  long left = argc > 2 ? strtol(argv[2], NULL, 10) : -1;
  const dds_entity_t participant = dds_create_participant(domain, NULL, NULL);
  if (participant < 0) {
    fprintf(stderr, "cannot join DDS domain %u: %s\n", domain, dds_strretcode(-participant));
    return 1;
  }
  const dds_entity_t topic = dds_create_topic(participant, &station_State_desc, "station/state", NULL, NULL);
  // Reliable and transient-local: the last value comes at once, even if it changed long ago.
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  const dds_entity_t waiting = dds_create_waitset(participant);
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  if (reader < 0 || dds_waitset_attach(waiting, reader, 0) < 0) {
    fprintf(stderr, "cannot read station/state\n");
    dds_delete(participant);  // its threads must not outlive the libraries that they use
    return 1;
  }
  while (left != 0) {
    dds_waitset_wait(waiting, NULL, 0, DDS_SECS(1));
    void* sample = NULL;  // lent
    dds_sample_info_t info;
    while (left != 0 && dds_take(reader, &sample, &info, 1, 1) > 0) {
      if (info.valid_data) {
        print(sample);
        left -= left > 0 ? 1 : 0;
      }
      dds_return_loan(reader, &sample, 1);
      sample = NULL;
    }
    dds_subscription_matched_status_t nodes;
    if (dds_get_subscription_matched_status(reader, &nodes) == 0 && nodes.current_count_change < 0 &&
        nodes.current_count == 0) {
      printf("no node publishes station/state any more\n");
      fflush(stdout);
    }
  }
  dds_delete(participant);
  return 0;
}

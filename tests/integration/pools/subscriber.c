// SPDX-License-Identifier: Apache-2.0
// A subscriber that knows only idl/pool.idl: puts the parts of chunks together and compares each byte with what the
// index of the chunk determines. Nothing of InduRoP is linked.
//   subscriber DOMAIN TOPIC COUNT    ends with 0 after COUNT whole chunks, with 1 if one is wrong, with 2 after 30 s
#include <dds/dds.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "pool.h"

struct chunk {
  uint64_t session, number, received;
  unsigned char* bytes;
};

static int is_right(const struct chunk* chunk, uint64_t size) {
  uint64_t word, found;
  memcpy(&word, chunk->bytes, sizeof word);
  for (uint64_t at = sizeof word; at < size; at += sizeof word) {
    word = word * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    memcpy(&found, chunk->bytes + at, sizeof found);
    if (found != word) {
      return 0;
    }
  }
  return 1;
}

// Returns 1 if the part makes the chunk whole. Parts of one sender arrive in order.
static int add(struct chunk* chunk, const indurop_pool_Part* part) {
  if (part->session != chunk->session || part->number != chunk->number) {
    chunk->session = part->session;
    chunk->number = part->number;
    chunk->received = 0;
    chunk->bytes = realloc(chunk->bytes, part->size);
  }
  if (part->offset + part->data._length > part->size) {
    return 0;
  }
  memcpy(chunk->bytes + part->offset, part->data._buffer, part->data._length);
  chunk->received += part->data._length;
  return chunk->received == part->size;
}

int main(int argc, char** argv) {
  if (argc < 4) {
    return 3;
  }
  const dds_entity_t participant = dds_create_participant((dds_domainid_t)strtoul(argv[1], NULL, 10), NULL, NULL);
  const dds_entity_t topic = dds_create_topic(participant, &indurop_pool_Part_desc, argv[2], NULL, NULL);
  dds_qos_t* qos = dds_create_qos();
  dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, 0);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 64);
  const dds_entity_t reader = dds_create_reader(participant, topic, qos, NULL);
  dds_delete_qos(qos);
  const dds_entity_t waiting = dds_create_waitset(participant);
  dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
  if (reader < 0 || dds_waitset_attach(waiting, reader, 0) < 0) {
    return 3;
  }
  struct chunk chunk = {0, 0, 0, NULL};
  long whole = 0;
  long wrong = 0;
  const long wanted = strtol(argv[3], NULL, 10);
  const dds_time_t end = dds_time() + DDS_SECS(30);
  while (whole < wanted && wrong == 0 && dds_time() < end) {
    dds_waitset_wait(waiting, NULL, 0, DDS_MSECS(100));
    void* sample = NULL;
    dds_sample_info_t info;
    while (dds_take(reader, &sample, &info, 1, 1) > 0) {
      const indurop_pool_Part* part = sample;
      if (info.valid_data && add(&chunk, part)) {
        ++whole;
        wrong += !is_right(&chunk, part->size);
        printf("%s %" PRIu64 " from %s\n", part->pool, part->number, part->node);
      }
      dds_return_loan(reader, &sample, 1);
      sample = NULL;
    }
  }
  printf("%ld whole, %ld wrong\n", whole, wrong);
  dds_delete(participant);
  return wrong > 0 ? 1 : whole < wanted ? 2 : 0;
}

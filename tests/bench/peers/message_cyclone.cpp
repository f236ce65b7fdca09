// SPDX-License-Identifier: Apache-2.0
// Cyclone DDS alone: a reliable writer and a reader in one participant, which no network is between.
#include <dds/dds.h>

#include <cstdint>
#include <string>

#include "measure.h"
#include "message.h"

namespace {

template <class Message>
void exchange(dds_entity_t participant, const dds_topic_descriptor_t& type, std::size_t bytes) {
  dds_qos_t* quality = dds_create_qos();
  dds_qset_reliability(quality, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
  dds_qset_history(quality, DDS_HISTORY_KEEP_LAST, 1);
  const std::string name = "peers_" + std::to_string(bytes);
  const dds_entity_t topic = dds_create_topic(participant, &type, name.c_str(), quality, nullptr);
  const dds_entity_t reader = dds_create_reader(participant, topic, quality, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, topic, quality, nullptr);
  dds_delete_qos(quality);
  Message message{};
  Message got{};
  std::uint8_t count = 0;
  peers::measure(bytes, [&] {
    message.data[0] = ++count;
    void* into = &got;
    dds_sample_info_t info{};
    return dds_write(writer, &message) == DDS_RETCODE_OK && dds_take(reader, &into, &info, 1, 1) == 1 &&
           got.data[0] == count;
  });
}

}  // namespace

int main() {
  const dds_entity_t participant = dds_create_participant(DDS_DOMAIN_DEFAULT, nullptr, nullptr);
  exchange<peers_Bytes64>(participant, peers_Bytes64_desc, 64);
  exchange<peers_Bytes256>(participant, peers_Bytes256_desc, 256);
  exchange<peers_Bytes4096>(participant, peers_Bytes4096_desc, 4096);
  return dds_delete(participant) == DDS_RETCODE_OK ? 0 : 1;
}

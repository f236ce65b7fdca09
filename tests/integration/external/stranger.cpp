// SPDX-License-Identifier: Apache-2.0
// Publishes a topic of its own with a DDS type that InduRoP's tools have never seen: stranger DOMAIN. Until it is
// killed.

#include <dds/dds.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>

#include "kinds.h"

int main(int argc, char** argv) {
  const auto domain = static_cast<dds_domainid_t>(argc > 1 ? std::atoi(argv[1]) : 0);
  const dds_entity_t participant = dds_create_participant(domain, nullptr, nullptr);
  const dds_entity_t topic = dds_create_topic(participant, &kinds_All_desc, "lab/probe", nullptr, nullptr);
  const dds_entity_t writer = dds_create_writer(participant, topic, nullptr, nullptr);
  if (writer < 0) {
    return 1;
  }
  kinds_All sample{};
  sample.text[0] = 'h';
  sample.text[1] = 'i';
  sample.colour = kinds_BLUE;
  sample.d = 2.5;
  for (std::uint32_t i = 0;; ++i) {
    sample.u32 = i;
    dds_write(writer, &sample);
    ::usleep(10'000);
  }
}

// SPDX-License-Identifier: Apache-2.0
#include "network/dds/wanted_topics.h"

namespace indurop::dds {

Result<void, base::Problem> WantedTopics::open(Handle participant) {
  own_ = guid_of(participant);
  reader_ = Entity(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, nullptr, nullptr));
  if (!reader_.ok()) {
    return base::Problem{reader_.why()};
  }
  return {};
}

void WantedTopics::take(const std::function<void(const std::string& topic)>& use) {
  take_all<dds_builtintopic_endpoint_t>(reader_.get(), [&](const auto& info_of_endpoint, const SampleInfo& info) {
    if (info.valid && guid_of(info_of_endpoint.participant_key) != own_ && info_of_endpoint.topic_name != nullptr) {
      use(info_of_endpoint.topic_name);
    }
  });
}

}  // namespace indurop::dds

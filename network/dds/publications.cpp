// SPDX-License-Identifier: Apache-2.0
#include "network/dds/publications.h"

#include <array>
#include <utility>

#include "network/dds/endpoint.h"
#include "network/dds/network_type.h"

namespace indurop::dds {
namespace {

constexpr std::uint32_t kAtOnce = 32;

}  // namespace

Result<void, base::Problem> Publications::open(Handle participant, rt::SignalWord& wake) {
  participant_ = participant;
  own_ = guid_of(participant);
  const Listener listener = wake_listener(wake);
  reader_ = Entity(dds_create_reader(participant, DDS_BUILTIN_TOPIC_DCPSPUBLICATION, nullptr, listener.get()));
  if (!reader_.ok()) {
    return base::Problem{reader_.why()};
  }
  return {};
}

std::vector<Publications::News> Publications::take() {
  constexpr std::uint32_t kNews = DDS_NOT_READ_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_ANY_INSTANCE_STATE;
  std::vector<News> news;
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  for (;;) {
    samples[0] = nullptr;
    // Read, not taken: types are later looked up in this reader.
    const int count = dds_read_mask(reader_.get(), samples.data(), infos.data(), kAtOnce, kAtOnce, kNews);
    if (count <= 0) {
      return news;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto& info_of_endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(samples[i]);
      const SampleInfo info(infos[i]);
      const Guid endpoint = guid_of(info_of_endpoint.key);
      const Guid participant = guid_of(info_of_endpoint.participant_key);
      if (!info.valid || !info.alive) {
        news.push_back({endpoint, std::nullopt});
      } else if (participant != own_ && info_of_endpoint.topic_name != nullptr) {
        news.push_back({endpoint, Publication{participant, info_of_endpoint.topic_name,
                                              info_of_endpoint.type_name == nullptr ? "" : info_of_endpoint.type_name,
                                              info.instance}});
      }
    }
    (void)dds_return_loan(reader_.get(), samples.data(), count);
  }
}

bool Publications::with(const Publication& publication,
                        const std::function<void(dds_builtintopic_endpoint_t&)>& use) const {
  // As large as in take(): DDS fills all memory that it loaned to this reader before, even if fewer samples are
  // requested.
  std::array<void*, kAtOnce> samples{};
  std::array<dds_sample_info_t, kAtOnce> infos{};
  const int count =
      dds_read_instance(reader_.get(), samples.data(), infos.data(), kAtOnce, kAtOnce, publication.instance);
  if (count <= 0) {
    return false;
  }
  const SampleInfo info(infos[0]);
  const bool there = info.valid && info.alive;
  if (there) {
    use(*static_cast<dds_builtintopic_endpoint_t*>(samples[0]));
  }
  (void)dds_return_loan(reader_.get(), samples.data(), count);
  return there;
}

Result<schema::Type, base::Problem> Publications::type_of(const Publication& publication,
                                                          std::int64_t timeout_ns) const {
  Result<schema::Type, base::Problem> type = base::Problem{"its publisher does not announce its type"};
  (void)with(publication, [&](dds_builtintopic_endpoint_t& info_of_endpoint) {
    const dds_typeinfo_t* information = nullptr;
    if (dds_builtintopic_get_endpoint_type_info(&info_of_endpoint, &information) >= 0 && information != nullptr) {
      type = type_from_network(participant_, *information, timeout_ns);
    }
  });
  return type;
}

}  // namespace indurop::dds

// SPDX-License-Identifier: Apache-2.0
#include "network/dds/guid.h"

#include <charconv>
#include <memory>

namespace indurop::dds {
namespace {

constexpr std::size_t kMaxReaders = 64;

struct EndpointDelete {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const noexcept { dds_builtintopic_free_endpoint(endpoint); }
};
using EndpointData = std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDelete>;

}  // namespace

Guid guid_of(Handle entity) noexcept {
  dds_guid_t guid{};
  (void)dds_get_guid(entity, &guid);
  return guid_of(guid);
}

std::optional<Guid> participant_of(Handle reader, InstanceHandle publication) {
  const EndpointData data(dds_get_matched_publication_data(reader, publication));
  return data == nullptr ? std::nullopt : std::optional(guid_of(data->participant_key));
}

std::string mark_of(Handle reader, InstanceHandle publication) {
  const EndpointData data(dds_get_matched_publication_data(reader, publication));
  void* info_of_endpoint = nullptr;
  std::size_t size = 0;
  if (data == nullptr || !dds_qget_userdata(data->qos, &info_of_endpoint, &size)) {
    return {};
  }
  std::string mark(static_cast<const char*>(info_of_endpoint), size);
  dds_free(info_of_endpoint);
  return mark;
}

bool is_marked(Handle reader, InstanceHandle publication, std::string_view mark) {
  return mark_of(reader, publication) == mark;
}

bool is_numbered_by(const Guid& participant, std::string_view subject) noexcept {
  // DDS Security 1.1, 9.3.3: one set bit, then the first 47 bits of the digest.
  constexpr std::size_t kBytes = 6;
  std::uint64_t number = 0;
  std::uint64_t digest = 0;
  if (subject.size() < 2 * kBytes ||
      std::from_chars(subject.data(), subject.data() + 2 * kBytes, digest, 16).ptr != subject.data() + 2 * kBytes) {
    return false;
  }
  for (std::size_t i = 0; i < kBytes; ++i) {
    number = number << 8U | participant[i];
  }
  constexpr std::uint64_t kMark = std::uint64_t{1} << (8 * kBytes - 1);
  return number == (kMark | digest >> 1U);
}

std::optional<std::uint32_t> readers_of(Handle writer) {
  dds_publication_matched_status_t matched{};
  return dds_get_publication_matched_status(writer, &matched) < 0 ? std::nullopt : std::optional(matched.current_count);
}

bool is_read_by(Handle writer, const Guid& participant) {
  std::array<dds_instance_handle_t, kMaxReaders> readers{};
  const int count = dds_get_matched_subscriptions(writer, readers.data(), readers.size());
  return std::any_of(readers.begin(), readers.begin() + std::clamp(count, 0, static_cast<int>(kMaxReaders)),
                     [&](auto handle) {
                       const EndpointData data(dds_get_matched_subscription_data(writer, handle));
                       return data != nullptr && guid_of(data->participant_key) == participant;
                     });
}

}  // namespace indurop::dds

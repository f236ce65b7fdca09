// SPDX-License-Identifier: Apache-2.0
#include "mirror/far_topic.h"

#include <algorithm>
#include <vector>

#include "mirror/endpoint.h"
#include "schema/ros_name.h"

namespace indurop::mirror {
namespace {

constexpr std::int64_t kTypeNs = 500'000'000;  // for the answer to a question about a type
constexpr std::int32_t kDepth = 64;            // values that may come between two looks
constexpr std::size_t kMostSubscribers = 64;
constexpr std::uint64_t kLargestKnown = 1U << 22U;  // what a board tells is not more than this

struct EndpointDelete {
  void operator()(dds_builtintopic_endpoint_t* endpoint) const noexcept { dds_builtintopic_free_endpoint(endpoint); }
};
using EndpointData = std::unique_ptr<dds_builtintopic_endpoint_t, EndpointDelete>;

// What the publisher offers, no more: with less, nothing would match.
Qos reader_qos(const dds_builtintopic_endpoint_t& publication) {
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_duration_t block = 0;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  (void)dds_qget_reliability(publication.qos, &reliability, &block);
  (void)dds_qget_durability(publication.qos, &durability);
  return make_qos({.reliable = reliability == DDS_RELIABILITY_RELIABLE,
                   .for_late_ones = durability != DDS_DURABILITY_VOLATILE,
                   .depth = kDepth});
}

}  // namespace

Guid guid_of(const dds_guid_t& guid) {
  Guid out{};
  std::copy(std::begin(guid.v), std::end(guid.v), out.begin());
  return out;
}

std::optional<Guid> participant_of(dds_entity_t reader, dds_instance_handle_t publication) {
  const EndpointData data(dds_get_matched_publication_data(reader, publication));
  return data == nullptr ? std::nullopt : std::optional(guid_of(data->participant_key));
}

FarTopic::~FarTopic() {
  close();
}

void FarTopic::close() noexcept {
  writer_.reset();
  reader_.reset();
  topic_.reset();
  senders_.clear();
  if (told_ != nullptr) {
    (void)dds_delete_topic_descriptor(told_);
    told_ = nullptr;
  }
  known_.reset();
}

bool FarTopic::open(dds_entity_t participant, dds_builtintopic_endpoint_t& publication, rt::SignalWord& wake) {
  const dds_typeinfo_t* information = nullptr;
  if (dds_builtintopic_get_endpoint_type_info(&publication, &information) < 0 || information == nullptr ||
      dds_create_topic_descriptor(DDS_FIND_SCOPE_GLOBAL, participant, information, kTypeNs, &told_) < 0) {
    told_ = nullptr;
    return false;
  }
  return read(participant, publication, *told_, wake);
}

bool FarTopic::open_ros(dds_entity_t participant, dds_builtintopic_endpoint_t& publication,
                        const schema::Variable& variable, rt::SignalWord& wake) {
  if (variable.type.size() > kLargestKnown) {
    return false;
  }
  known_.emplace(variable.type, schema::ros_type_name(variable));
  return read(participant, publication, known_->descriptor(), wake);
}

bool FarTopic::read(dds_entity_t participant, const dds_builtintopic_endpoint_t& publication,
                    const dds_topic_descriptor_t& type, rt::SignalWord& wake) {
  size_ = type.m_size;
  topic_ = Entity(dds_create_topic(participant, &type, publication.topic_name, nullptr, nullptr));
  const Listener listener =
      data_listener([](dds_entity_t /*reader*/, void* word) { static_cast<rt::SignalWord*>(word)->wake(); }, &wake);
  const Qos qos = reader_qos(publication);
  reader_ = topic_.ok() ? Entity(dds_create_reader(participant, topic_.get(), qos.get(), listener.get())) : Entity();
  if (!reader_.ok()) {
    close();
  }
  return reader_.ok();
}

void FarTopic::take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use) {
  if (!reader_.ok()) {
    return;
  }
  take_all<std::uint8_t>(reader_.get(), [&](const std::uint8_t& sample, const dds_sample_info_t& info) {
    if (!info.valid_data) {
      return;
    }
    auto sender = senders_.find(info.publication_handle);
    if (sender == senders_.end()) {
      const auto participant = participant_of(reader_.get(), info.publication_handle);
      // Who is gone already cannot be asked any more; what he said last is nobody's.
      if (!participant) {
        return;
      }
      sender = senders_.emplace(info.publication_handle, *participant).first;
    }
    use(sender->second, {&sample, size_});
  });
}

bool FarTopic::send(dds_entity_t participant, const Guid& to, std::span<const std::uint8_t> value) {
  if (!topic_.ok() || value.size() > size_) {
    return false;
  }
  if (!writer_.ok()) {
    const Qos qos = make_qos({.for_late_ones = false});
    writer_ = Entity(dds_create_writer(participant, topic_.get(), qos.get(), nullptr));
  }
  std::array<dds_instance_handle_t, kMostSubscribers> readers{};
  const int count = dds_get_matched_subscriptions(writer_.get(), readers.data(), readers.size());
  const bool listens = std::any_of(
      readers.begin(), readers.begin() + std::clamp(count, 0, static_cast<int>(kMostSubscribers)), [&](auto handle) {
        const EndpointData data(dds_get_matched_subscription_data(writer_.get(), handle));
        return data != nullptr && guid_of(data->participant_key) == to;
      });
  if (!listens) {
    return false;
  }
  std::vector<std::uint64_t> sample((size_ + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  std::copy(value.begin(), value.end(), reinterpret_cast<std::uint8_t*>(sample.data()));
  return dds_write(writer_.get(), sample.data()) >= 0;
}

}  // namespace indurop::mirror

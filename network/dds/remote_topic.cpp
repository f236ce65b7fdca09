// SPDX-License-Identifier: Apache-2.0
#include "network/dds/remote_topic.h"

#include <algorithm>
#include <vector>

#include "network/dds/endpoint.h"

namespace indurop::dds {
namespace {

constexpr std::int64_t kTypeNs = 500'000'000;       // timeout of a request for a type
constexpr std::int32_t kDepth = 64;                 // maximum number of values between two polls
constexpr std::uint64_t kLargestKnown = 1U << 22U;  // types announced by a board are not larger

// Requests only the QoS that the publisher offers: otherwise nothing would match.
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

RemoteTopic::~RemoteTopic() {
  close();
}

void RemoteTopic::close() noexcept {
  writer_.reset();
  reader_.reset();
  topic_.reset();
  senders_.clear();
  if (descriptor_ != nullptr) {
    (void)dds_delete_topic_descriptor(descriptor_);
    descriptor_ = nullptr;
  }
  known_.reset();
}

bool RemoteTopic::open(Handle participant, const Publications& all, const Publication& publication,
                       rt::SignalWord& wake) {
  (void)all.with(publication, [&](dds_builtintopic_endpoint_t& info_of_endpoint) {
    const dds_typeinfo_t* information = nullptr;
    if (dds_builtintopic_get_endpoint_type_info(&info_of_endpoint, &information) < 0 || information == nullptr ||
        dds_create_topic_descriptor(DDS_FIND_SCOPE_GLOBAL, participant, information, kTypeNs, &descriptor_) < 0) {
      descriptor_ = nullptr;
      return;
    }
    read(participant, info_of_endpoint, *descriptor_, wake);
  });
  return is_open();
}

bool RemoteTopic::open_as(const schema::Type& type, const std::string& type_name, Handle participant,
                          const Publications& all, const Publication& publication, rt::SignalWord& wake) {
  if (type.size() > kLargestKnown) {
    return false;
  }
  (void)all.with(publication, [&](dds_builtintopic_endpoint_t& info_of_endpoint) {
    known_.emplace(type, type_name);
    read(participant, info_of_endpoint, known_->descriptor(), wake);
  });
  return is_open();
}

void RemoteTopic::read(Handle participant, const dds_builtintopic_endpoint_t& publication, const TypeDescriptor& type,
                       rt::SignalWord& wake) {
  size_ = type.m_size;
  topic_ = Entity(dds_create_topic(participant, &type, publication.topic_name, nullptr, nullptr));
  const Listener listener = wake_listener(wake);
  const Qos qos = reader_qos(publication);
  reader_ = topic_.ok() ? Entity(dds_create_reader(participant, topic_.get(), qos.get(), listener.get())) : Entity();
  may_not_read_ = topic_.forbidden() || reader_.forbidden();
  if (!reader_.ok()) {
    close();
  }
}

void RemoteTopic::take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use) {
  if (!reader_.ok()) {
    return;
  }
  take_all<std::uint8_t>(reader_.get(), [&](const std::uint8_t& sample, const SampleInfo& info) {
    if (!info.valid) {
      return;
    }
    auto sender = senders_.find(info.publication);
    if (sender == senders_.end()) {
      const auto participant = participant_of(reader_.get(), info.publication);
      // A participant that has gone cannot be looked up any more; its last values are discarded.
      if (!participant) {
        return;
      }
      sender = senders_.emplace(info.publication, *participant).first;
    }
    use(sender->second, {&sample, size_});
  });
}

bool RemoteTopic::send(Handle participant, const Guid& to, std::span<const std::uint8_t> value) {
  if (!topic_.ok() || value.size() > size_) {
    return false;
  }
  if (!writer_.ok()) {
    const Qos qos = make_qos({.for_late_ones = false, .mark = kToolMark});
    writer_ = Entity(dds_create_writer(participant, topic_.get(), qos.get(), nullptr));
    may_not_send_ = writer_.forbidden();
  }
  if (!writer_.ok() || !is_read_by(writer_.get(), to)) {
    return false;
  }
  std::vector<std::uint64_t> sample((size_ + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t));
  std::copy(value.begin(), value.end(), reinterpret_cast<std::uint8_t*>(sample.data()));
  return write_bytes(writer_.get(), sample.data()).ok();
}

}  // namespace indurop::dds

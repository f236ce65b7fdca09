// SPDX-License-Identifier: Apache-2.0
// One topic of the external plane, read and written with a type that only the network knows.

#pragma once

#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "mirror/entity.h"
#include "rt/signal_word.h"

namespace indurop::mirror {

using Guid = std::array<std::uint8_t, 16>;
Guid guid_of(const dds_guid_t& guid);
// Of the participant behind a matched publication of a reader.
std::optional<Guid> participant_of(dds_entity_t reader, dds_instance_handle_t publication);

class FarTopic {
 public:
  FarTopic() = default;
  FarTopic(const FarTopic&) = delete;
  FarTopic& operator=(const FarTopic&) = delete;
  ~FarTopic();

  // Reads what `publication` publishes, under its own QoS. False: its type cannot be had now. `wake` is woken by
  // values.
  bool open(dds_entity_t participant, dds_builtintopic_endpoint_t& publication, rt::SignalWord& wake);
  [[nodiscard]] bool is_open() const noexcept { return reader_.ok(); }
  void close() noexcept;

  // Values that have come, with the participant they are from.
  void take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use);
  // False while this participant does not listen (yet).
  bool send(dds_entity_t participant, const Guid& to, std::span<const std::uint8_t> value);

 private:
  dds_topic_descriptor_t* type_ = nullptr;
  Entity topic_;
  Entity reader_;
  Entity writer_;
  std::map<dds_instance_handle_t, Guid> senders_;  // participants by publication
};

}  // namespace indurop::mirror

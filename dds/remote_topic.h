// SPDX-License-Identifier: Apache-2.0
// A topic of somebody else, read and written with a type that only the network, or whoever opens it, knows. One thread
// uses it.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "dds/entity.h"
#include "dds/guid.h"
#include "dds/plain_type.h"
#include "dds/publications.h"
#include "rt/signal_word.h"

namespace indurop::dds {

// What the writers of tools are marked with: whoever has a write lock knows them from programs that belong to the
// plant.
inline constexpr std::string_view kToolMark = "indurop tool";

class RemoteTopic {
 public:
  RemoteTopic() = default;
  RemoteTopic(const RemoteTopic&) = delete;
  RemoteTopic& operator=(const RemoteTopic&) = delete;
  ~RemoteTopic();

  // Reads what `publication` publishes, under its own QoS. False: it is gone, or its type cannot be had now. Values
  // wake `wake`, which is borrowed.
  bool open(Handle participant, const Publications& all, const Publication& publication, rt::SignalWord& wake);
  // The same where the network is told no type: this one, under this name.
  bool open_as(const schema::Type& type, const std::string& type_name, Handle participant, const Publications& all,
               const Publication& publication, rt::SignalWord& wake);
  [[nodiscard]] bool is_open() const noexcept { return reader_.ok(); }
  void close() noexcept;
  // The keys of this participant do not permit to read it, or to send to it. As far as that was tried.
  [[nodiscard]] bool may_not_read() const noexcept { return may_not_read_; }
  [[nodiscard]] bool may_not_send() const noexcept { return may_not_send_; }

  // Values that have come, with the participant they are from.
  void take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use);
  // False while this participant does not listen (yet).
  bool send(Handle participant, const Guid& to, std::span<const std::uint8_t> value);

 private:
  void read(Handle participant, const dds_builtintopic_endpoint_t& publication, const TypeDescriptor& type,
            rt::SignalWord& wake);

  TypeDescriptor* told_ = nullptr;  // the type as the network tells it, or
  std::optional<PlainType> known_;  // as whoever opens it does
  std::size_t size_ = 0;            // of a sample
  Entity topic_;
  Entity reader_;
  Entity writer_;
  bool may_not_read_ = false;
  bool may_not_send_ = false;
  std::map<InstanceHandle, Guid> senders_;  // participants by publication
};

}  // namespace indurop::dds

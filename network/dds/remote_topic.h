// SPDX-License-Identifier: Apache-2.0
// A topic of another participant, read and written with a type from the network or from the caller. Used by one thread.

#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/rt/signal_word.h"
#include "network/dds/entity.h"
#include "network/dds/guid.h"
#include "network/dds/plain_type.h"
#include "network/dds/publications.h"

namespace indurop::dds {

// Mark of the writers of tools, by which the owner of a write lock distinguishes them from programs of the plant.
inline constexpr std::string_view kToolMark = "indurop tool";

class RemoteTopic {
 public:
  RemoteTopic() = default;
  RemoteTopic(const RemoteTopic&) = delete;
  RemoteTopic& operator=(const RemoteTopic&) = delete;
  ~RemoteTopic();

  // Reads `publication` with its QoS. Returns false if it is gone or its type is not available now. Values wake `wake`,
  // which is borrowed.
  bool open(Handle participant, const Publications& all, const Publication& publication, rt::SignalWord& wake);
  // The same with this type and type name, for publications that announce no type.
  bool open_as(const schema::Type& type, const std::string& type_name, Handle participant, const Publications& all,
               const Publication& publication, rt::SignalWord& wake);
  [[nodiscard]] bool is_open() const noexcept { return reader_.ok(); }
  void close() noexcept;
  // Return true if the keys of this participant do not permit reading or sending, as far as that was tried.
  [[nodiscard]] bool may_not_read() const noexcept { return may_not_read_; }
  [[nodiscard]] bool may_not_send() const noexcept { return may_not_send_; }

  // Calls `use` for the received values, with the participant that sent them.
  void take(const std::function<void(const Guid& from, std::span<const std::uint8_t> value)>& use);
  // Returns false while this participant has no matching reader (yet).
  bool send(Handle participant, const Guid& to, std::span<const std::uint8_t> value);

 private:
  void read(Handle participant, const dds_builtintopic_endpoint_t& publication, const TypeDescriptor& type,
            rt::SignalWord& wake);

  TypeDescriptor* descriptor_ = nullptr;  // the type from the network, or
  std::optional<PlainType> known_;        // the type from the caller
  std::size_t size_ = 0;                  // of a sample, in bytes
  Entity topic_;
  Entity reader_;
  Entity writer_;
  bool may_not_read_ = false;
  bool may_not_send_ = false;
  std::map<InstanceHandle, Guid> senders_;  // participants by publication
};

}  // namespace indurop::dds

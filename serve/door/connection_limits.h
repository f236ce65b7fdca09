// SPDX-License-Identifier: Apache-2.0
// How many connections there may be, and which one has to end when a further one comes: those that ask for nothing
// (idle, or too slow to say what they want) never keep the others out. Pure numbers, no sockets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace indurop::serve {

// Whose limits an address counts for: an IPv4 address as it is, of an IPv6 address the network (its first 64 bits),
// because whoever has one of it has all of it.
std::string limits_key(const std::string& address);

class ConnectionLimits {
 public:
  using Id = std::uint64_t;  // given by admit()

  // `of_one`: of one address; those of this machine (`loopback`) have no limit of their own, they all look the same.
  ConnectionLimits(std::size_t most, std::size_t of_one) : most_(most), of_one_(of_one) {}

  struct Admission {
    Id id = 0;                  // 0: it may not come in
    std::optional<Id> instead;  // which has to end for it; it counts no more
  };
  // A new connection: waiting() until said otherwise.
  Admission admit(const std::string& address, bool loopback);
  // From now on it may be ended in favour of others, the longest waiting first.
  void waiting(Id id);
  // It may not: its request is being answered, or it is a stream.
  void busy(Id id);
  void gone(Id id) { all_.erase(id); }
  [[nodiscard]] std::size_t size() const noexcept { return all_.size(); }

 private:
  struct One {
    std::string key;
    std::uint64_t since = 0;  // 0: busy
  };
  [[nodiscard]] std::optional<Id> longest_waiting(const std::string* key) const;

  std::size_t most_;
  std::size_t of_one_;
  Id last_ = 0;
  std::uint64_t clock_ = 0;
  std::map<Id, One> all_;
};

}  // namespace indurop::serve

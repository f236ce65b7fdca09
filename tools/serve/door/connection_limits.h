// SPDX-License-Identifier: Apache-2.0
// Limits the number of connections, and selects the one to end when another one comes: connections without a request
// (idle, or too slow to send it) never block others. Pure numbers, no sockets.

#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace indurop::serve {

// Returns the key under which an address is limited: an IPv4 address itself, of an IPv6 address the network (its first
// 64 bits), because the owner of one such address has all of them.
std::string limits_key(const std::string& address);

class ConnectionLimits {
 public:
  using Id = std::uint64_t;  // assigned by admit()

  // `of_one`: maximum of one address; those of this machine (`loopback`) have no limit of their own, since they all
  // look the same.
  ConnectionLimits(std::size_t most, std::size_t of_one) : most_(most), of_one_(of_one) {}

  struct Admission {
    Id id = 0;                  // 0: rejected
    std::optional<Id> instead;  // connection to end for it; it is no longer counted
  };
  // Admits a new connection, which is in the state of waiting().
  Admission admit(const std::string& address, bool loopback);
  // From now on it may be ended in favour of others, the longest waiting one first.
  void waiting(Id id);
  // It must not be ended: its request is being answered, or it is a stream.
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

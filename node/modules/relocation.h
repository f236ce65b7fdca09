// SPDX-License-Identifier: Apache-2.0
// Where variables of one process lie in another one, to put addresses back that lead to them. Not real-time safe.

#pragma once

#include <indurop/state.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace indurop::node {

class Relocation {
 public:
  // A variable of `size` bytes that began at `before` begins at `now`.
  void add(std::uint64_t before, std::uint64_t size, std::uint64_t now) { places_.push_back({before, size, now}); }

  // Returns where the address leads to now; nullopt: to none of the variables. 0 leads to 0, and an address whose
  // variable has ended remains as it is.
  [[nodiscard]] std::optional<std::uint64_t> find(const StateAddress& address) const;

 private:
  struct Place {
    std::uint64_t before = 0;
    std::uint64_t size = 0;
    std::uint64_t now = 0;
  };
  std::vector<Place> places_;
};

}  // namespace indurop::node

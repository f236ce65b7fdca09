// SPDX-License-Identifier: Apache-2.0
// Memory for shared variables while there is no node: private to this process, with their initial values, one entry per
// name and type however many modules declare it.

#pragma once

#include <indurop/detail/abi.h>

#include <cstdint>
#include <cstdlib>
#include <map>
#include <memory>
#include <utility>

namespace indurop::runtime {

class PrivateMemory {
 public:
  // Returns the variable's entry, created at the first call. Never null: if there is no memory the process ends with a
  // message.
  void* entry_of(const abi::Ref& ref);

 private:
  struct Free {
    void operator()(void* memory) const noexcept { std::free(memory); }  // NOLINT: from aligned_alloc
  };
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::unique_ptr<void, Free>> entries_;
};

}  // namespace indurop::runtime

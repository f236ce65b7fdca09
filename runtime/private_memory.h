// SPDX-License-Identifier: Apache-2.0
// Where shared variables live as long as no node is there: memory of this process with their initial values, one entry
// per name and type however many modules declare it.

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
  // The variable's entry, made at the first call. Never null: without memory for it the process ends with a message.
  void* entry_of(const abi::Ref& ref);

 private:
  struct Free {
    void operator()(void* memory) const noexcept { std::free(memory); }  // NOLINT: from aligned_alloc
  };
  std::map<std::pair<std::uint64_t, std::uint64_t>, std::unique_ptr<void, Free>> entries_;
};

}  // namespace indurop::runtime

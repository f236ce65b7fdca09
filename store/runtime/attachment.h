// SPDX-License-Identifier: Apache-2.0
// This process's access to one store: finds variables and shared functions by their hash.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "store/vars/call_layout.h"
#include "store/vars/store.h"

namespace indurop::runtime {

class Attachment {
 public:
  // Opens the store of `node`. Errors: those of Store::attach.
  static Result<Attachment> open(const std::string& node);
  // Uses the node's own store, which the caller owns.
  explicit Attachment(vars::Store& store);
  Attachment(Attachment&&) = default;
  Attachment& operator=(Attachment&&) = delete;

  [[nodiscard]] const std::string& node() const noexcept { return node_; }
  [[nodiscard]] vars::Store& store() const noexcept { return borrowed_ != nullptr ? *borrowed_ : *owned_; }
  // Returns true if a newer block has replaced this one. Real-time safe.
  [[nodiscard]] bool retired() const noexcept { return store().retired(); }

  // Returns null if the node does not know the function. Real-time safe.
  [[nodiscard]] vars::CallFunction* function(std::uint64_t name_hash) const noexcept;
  [[nodiscard]] std::uint32_t index_of(const vars::CallFunction& function) const noexcept {
    return static_cast<std::uint32_t>(&function - functions_.data());
  }
  // The function whose wake word the server of `function` sleeps on.
  [[nodiscard]] vars::CallFunction& wake_of(const vars::CallFunction& function) const noexcept;
  [[nodiscard]] vars::CallSlot& slot(const vars::CallFunction& function, std::size_t index) const noexcept;

 private:
  explicit Attachment(vars::Store&& store);
  void find_functions();

  mutable std::optional<vars::Store> owned_;
  vars::Store* borrowed_ = nullptr;
  std::string node_;
  std::byte* block_ = nullptr;
  std::span<vars::CallFunction> functions_;  // sorted by name hash; empty if the block's data is inconsistent
};

}  // namespace indurop::runtime

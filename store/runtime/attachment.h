// SPDX-License-Identifier: Apache-2.0
// This process's access to one store: finds variables and shared functions by their hash.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>

#include "store/vars/call_area.h"
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

  [[nodiscard]] const vars::CallArea& calls() const noexcept { return calls_; }

 private:
  explicit Attachment(vars::Store&& store);

  mutable std::optional<vars::Store> owned_;
  vars::Store* borrowed_ = nullptr;
  std::string node_;
  vars::CallArea calls_;
};

}  // namespace indurop::runtime

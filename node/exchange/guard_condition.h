// SPDX-License-Identifier: Apache-2.0
// A condition on one shared number, "O0 == 0", that must hold after an exchange. Not real-time safe.

#pragma once

#include <indurop/result.h>

#include <string>
#include <string_view>

#include "core/base/problem.h"
#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace indurop::node {

class GuardCondition {
 public:
  // Errors: not NAME COMPARISON VALUE, no such variable, it is no number; the text says which.
  static Result<GuardCondition, base::Problem> parse(std::string_view text, const vars::Store& store);
  [[nodiscard]] bool holds(const vars::Store& store) const;
  [[nodiscard]] const std::string& text() const noexcept { return text_; }
  // Hash of its name.
  [[nodiscard]] std::uint64_t variable() const noexcept { return entry_.name_hash; }

 private:
  std::string text_;
  vars::DirectoryEntry entry_{};
  std::uint32_t offset_ = 0;
  schema::Type type_;
  schema::Alarm condition_;
};

}  // namespace indurop::node

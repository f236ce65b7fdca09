// SPDX-License-Identifier: Apache-2.0
// The text of a header: lines, inside or outside a namespace.

#pragma once

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include "glb2idl/text.h"

namespace indurop::glb2idl {

class HeaderText {
 public:
  template <class... Argument>
  void line(fmt::format_string<Argument...> format, Argument&&... arguments) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Argument>(arguments)...);
    out_ += '\n';
  }

  // Closes the open namespace and opens `scope`, unless it is already open. "": none.
  void enter(std::string_view scope) {
    if (scope == current_) {
      return;
    }
    if (!current_.empty()) {
      line("}}  // namespace {}", current_);
    }
    if (!scope.empty()) {
      line("");
      line("namespace {} {{", scope);
    }
    current_ = scope;
  }

  // Returns a comment to append to a declaration; "" for none.
  static std::string comment(const std::string& text) { return text.empty() ? "" : "  // " + comment_line(text); }

  [[nodiscard]] std::string take() { return std::move(out_); }

 private:
  std::string out_;
  std::string current_;
};

}  // namespace indurop::glb2idl

// SPDX-License-Identifier: Apache-2.0
// Collects the messages of one compilation and prints them as "file:line:col: error: what, what to do" with the
// source line and a caret below.

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "glb2idl/source.h"

namespace indurop::glb2idl {

class Diagnostics {
 public:
  static constexpr std::size_t kLimit = 100;

  explicit Diagnostics(const Sources& sources) : sources_(sources) {}

  // Beyond kLimit errors nothing more is kept.
  void error(Span at, std::string text) { add(at, std::move(text)); }
  // About the command line or a whole file, without a place.
  void error(std::string text) { add(std::nullopt, std::move(text)); }

  [[nodiscard]] bool failed() const noexcept { return errors_ != 0; }
  [[nodiscard]] std::size_t errors() const noexcept { return errors_; }
  // Ordered by file and place.
  [[nodiscard]] std::string render() const;
  // "knuRobot.glb:3", for texts that refer to another place.
  [[nodiscard]] std::string place(Span at) const;

 private:
  struct Message {
    std::optional<Span> at;
    std::string text;
  };
  void add(std::optional<Span> at, std::string text);

  const Sources& sources_;
  std::vector<Message> messages_;
  std::size_t errors_ = 0;
};

}  // namespace indurop::glb2idl

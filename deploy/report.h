// SPDX-License-Identifier: Apache-2.0
// Collects diagnostics of one file in the order they are found, of each severity as many as people still read.

#pragma once

#include <array>
#include <string>
#include <vector>

#include "deploy/config.h"

namespace indurop::deploy {

class Report {
 public:
  static constexpr std::size_t kMost = 200;  // of one severity

  Report(std::string file, std::vector<Diagnostic>& out) : file_(std::move(file)), out_(out) {}

  void error(Place place, std::string text) { add(Diagnostic::Severity::Error, place, std::move(text)); }
  void warning(Place place, std::string text) { add(Diagnostic::Severity::Warning, place, std::move(text)); }
  void note(Place place, std::string text) { add(Diagnostic::Severity::Note, place, std::move(text)); }
  // So many errors that further ones are not shown: searching for their causes is in vain.
  [[nodiscard]] bool full() const noexcept { return count_[0] > kMost; }

 private:
  void add(Diagnostic::Severity severity, Place place, std::string text);

  std::string file_;
  std::vector<Diagnostic>& out_;
  std::array<std::size_t, 3> count_{};  // by severity
};

}  // namespace indurop::deploy

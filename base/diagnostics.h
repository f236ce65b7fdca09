// SPDX-License-Identifier: Apache-2.0
// Collects what is wrong, all of it in one go: each thing once, of each severity as many as people still read.

#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "base/diagnostic.h"

namespace indurop::base {

// Not thread-safe. Not real-time safe.
class Diagnostics {
 public:
  static constexpr std::size_t kMost = 200;

  // `file`: what error(), warning() and note() are about. Appends to `out`, which is borrowed. `most` of one severity
  // are kept.
  Diagnostics(std::string file, std::vector<Diagnostic>& out, std::size_t most = kMost)
      : file_(std::move(file)), most_(most), out_(out) {}

  void error(SourcePlace place, std::string text) { add(Diagnostic::Severity::Error, place, std::move(text)); }
  void warning(SourcePlace place, std::string text) { add(Diagnostic::Severity::Warning, place, std::move(text)); }
  void note(SourcePlace place, std::string text) { add(Diagnostic::Severity::Note, place, std::move(text)); }
  // Left out if the same text was there already about this place, or if there are too many.
  void add(Diagnostic one);
  // Appends of which severities there were more than are kept.
  void add_summary(std::vector<Diagnostic>& to) const;

  // Those left out because there were too many count too.
  [[nodiscard]] std::size_t errors() const noexcept { return count_[0]; }
  [[nodiscard]] bool failed() const noexcept { return errors() > 0; }
  // Further ones of this severity are not kept: their texts need not be made.
  [[nodiscard]] bool full(Diagnostic::Severity severity) const noexcept {
    return count_[static_cast<std::size_t>(severity)] > most_;
  }
  // So many errors that further ones are not shown: searching for their causes is in vain.
  [[nodiscard]] bool full() const noexcept { return errors() > most_; }

 private:
  void add(Diagnostic::Severity severity, SourcePlace place, std::string text);

  std::string file_;
  std::size_t most_;
  std::vector<Diagnostic>& out_;
  std::array<std::size_t, 3> count_{};                              // by severity
  std::set<std::tuple<std::string, int, int, std::string>> known_;  // file, line, column, text of those kept
};

}  // namespace indurop::base

// SPDX-License-Identifier: Apache-2.0
// Collects all diagnostics in one pass: each one once, and of each severity only as many as users still read.

#pragma once

#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::base {

// Not thread-safe. Not real-time safe.
class Diagnostics {
 public:
  static constexpr std::size_t kMaxShown = 200;

  // `file`: the file that error(), warning() and note() are about. Appends to `out`, which is borrowed. At most `most`
  // diagnostics of one severity are kept.
  Diagnostics(std::string file, std::vector<Diagnostic>& out, std::size_t most = kMaxShown)
      : file_(std::move(file)), most_(most), out_(out) {}

  void error(SourcePlace place, std::string text) { add(Diagnostic::Severity::Error, place, std::move(text)); }
  void warning(SourcePlace place, std::string text) { add(Diagnostic::Severity::Warning, place, std::move(text)); }
  void note(SourcePlace place, std::string text) { add(Diagnostic::Severity::Note, place, std::move(text)); }
  // Leaves it out if the same text about this place was added already, or if there are too many.
  void add(Diagnostic one);
  // Appends which severities had more diagnostics than were kept.
  void add_summary(std::vector<Diagnostic>& to) const;

  // Includes those left out because there were too many.
  [[nodiscard]] std::size_t errors() const noexcept { return count_[0]; }
  [[nodiscard]] bool failed() const noexcept { return errors() > 0; }
  // Returns true if further ones of this severity are not kept: their texts need not be made.
  [[nodiscard]] bool full(Diagnostic::Severity severity) const noexcept {
    return count_[static_cast<std::size_t>(severity)] > most_;
  }
  // Returns true if further errors are not shown: it is useless to search for more.
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

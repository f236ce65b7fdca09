// SPDX-License-Identifier: Apache-2.0
// Compares what repeated runs write with what the recording has, and writes it as a recording if one is wanted.

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "node/replay/forced_then.h"
#include "node/replay/output.h"
#include "node/replay/replayed_module.h"
#include "node/run/console.h"

namespace indurop::node {

class Comparison {
 public:
  // Both are borrowed.
  Comparison(vars::Store& store, const Console& console) noexcept : store_(store), console_(console) {}

  // Values of variables that were forced are not compared.
  void expect_forces(ForcedThen forced) { forced_then_ = std::move(forced); }
  // Opens the recording to write. `of`: the recording that is replayed; `real_minus_node_ns`: its times minus those of
  // the node. Returns false after an error.
  bool open_output(const std::filesystem::path& path, const std::string& of, std::int64_t real_minus_node_ns);
  void close_output();

  // Compares the outputs of the run that was repeated last with the known values of its module, with which the next run
  // begins.
  void compare(ReplayedModule& module, const recorder::RunWords& run);

  [[nodiscard]] std::uint64_t values() const noexcept { return values_; }
  [[nodiscard]] std::uint64_t differences() const noexcept { return differences_; }
  // Differences of runs whose inputs changed while they ran.
  [[nodiscard]] std::uint64_t unclear() const noexcept { return unclear_; }
  // Numbers of values that were not compared because they were forced, by variable.
  [[nodiscard]] const std::map<std::string, std::uint64_t>& forced() const noexcept { return forced_; }
  [[nodiscard]] bool output_failed() const noexcept { return output_failed_; }

 private:
  void compare(const ReplayedModule& module, KnownValue& known, const recorder::RunWords& run);
  [[nodiscard]] const schema::Variable& declaration_of(const KnownValue& known) const;
  [[nodiscard]] bool read_now(const KnownValue& known);
  void note_difference(const ReplayedModule& module, KnownValue& known, std::uint64_t tick, bool fits);
  void write_output(const KnownValue& known, const std::vector<std::uint8_t>& cdr, std::int64_t end_ns);

  vars::Store& store_;
  const Console& console_;
  ForcedThen forced_then_;
  std::int64_t real_minus_node_ns_ = 0;
  std::optional<ReplayOutput> output_;
  bool output_failed_ = false;
  std::uint64_t values_ = 0;
  std::uint64_t differences_ = 0;
  std::uint64_t unclear_ = 0;
  std::map<std::string, std::uint64_t> differing_;  // numbers of differing values, by variable
  std::map<std::string, std::uint64_t> forced_;
  std::vector<std::uint8_t> now_;  // the value that is compared
  std::vector<std::uint8_t> cdr_;
};

}  // namespace indurop::node

// SPDX-License-Identifier: Apache-2.0
// Reads a recording as values and runs, in their order, for the variables of a store.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "core/base/exit_code.h"
#include "core/base/problem.h"
#include "history/explain/facts.h"
#include "history/recorder/run_words.h"
#include "history/recorder/sources.h"
#include "history/recorder/versions.h"
#include "history/recording/last_messages.h"
#include "history/recording/mcap_reader.h"
#include "store/vars/store.h"

namespace indurop::node {

struct RecordedValue {
  recorder::ValueWords words;
  std::uint32_t variable = 0;  // index in the store's directory
  std::span<const std::uint8_t> cdr;
};
struct RecordedRun {
  recorder::RunWords words;
};

struct RecordedClock {
  std::uint32_t module = 0;
  std::int64_t now_ns = 0;
};

struct RecordedAnswer {
  std::uint32_t module = 0;
  recorder::AnswerRecord words;
};

struct RecordedKeyframe {
  std::uint32_t module = 0;
  recorder::KeyframeRecord words;
  const std::string* form = nullptr;  // of its bytes
};

// Why a recording cannot be used, and the exit code for that.
struct Unfit {
  std::string text;
  int code = kFailed;
};

class RecordedRuns {
 public:
  // `board`: the board to replay, of a file that was joined; else empty. The store is borrowed. Errors: no recording of
  // runs, or none of this board; a variable has another type now (kSchemaMismatch).
  // Values of variables whose type has changed are read as they were declared (`former`).
  static Result<RecordedRuns, Unfit> open(const std::filesystem::path& path, const std::string& board,
                                          const vars::Store& store, std::span<const schema::Variable> former = {});
  // Returns the node that was recorded. Errors: as open().
  static Result<std::string, Unfit> node_of(const std::filesystem::path& path, const std::string& board);

  // Returns the next item; nullopt after the last. Views in it are valid until the next call.
  // Errors: a part of the file is damaged; the next call continues after it.
  using Item = std::variant<RecordedValue, RecordedRun, RecordedClock, RecordedAnswer, RecordedKeyframe>;
  Result<std::optional<Item>, base::Problem> next();

  // The log time of what next() returned last.
  [[nodiscard]] std::uint64_t time_ns() const noexcept { return time_ns_; }
  // next() continues with the first item that is not older than this log time.
  void seek(std::uint64_t log_time_ns) { reader_.seek(log_time_ns); }
  // Returns the log time of the first run of this tick or a later one; nullopt: there is none.
  [[nodiscard]] std::optional<std::uint64_t> time_of_tick(std::uint64_t tick) const;
  // Log times of the first and the last item.
  [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> span_ns() const;

  // The last value of a variable before a time, as a module of the recording knew it.
  struct EarlierValue {
    std::uint32_t variable = 0;
    std::uint32_t module = 0;  // kAnyModule: the one that was recorded last
    std::vector<std::uint8_t> cdr;
  };
  static constexpr std::uint32_t kAnyModule = recording::kAnyPart;
  using VariableOf = std::pair<std::uint32_t, std::uint32_t>;  // a variable, and a module or kAnyModule
  [[nodiscard]] std::vector<EarlierValue> values_before(std::uint64_t log_time_ns,
                                                        const std::set<VariableOf>& wanted) const;
  // Returns true if the recording has values of this variable.
  [[nodiscard]] bool has_values_of(std::uint32_t variable) const noexcept;
  // Returns true if no run is missing between the first and the last one of a module, as far as its recorder knew.
  [[nodiscard]] bool is_without_gaps() const noexcept { return without_gaps_; }

  // Returns true if the recording has keyframes of the module of this name.
  [[nodiscard]] bool has_keyframes(const std::string& module) const;
  // kRecordingFormat of the program that recorded it.
  [[nodiscard]] std::int64_t format() const noexcept { return format_; }
  // CLOCK_REALTIME minus the node's time, when recorded; 0: virtual time.
  [[nodiscard]] std::int64_t real_minus_node_ns() const noexcept { return real_minus_node_ns_; }
  [[nodiscard]] const std::string& node() const noexcept { return node_; }
  // The versions of its modules' code, by module and first run; empty: recorded by an older release.
  [[nodiscard]] const std::vector<recorder::RecordedVersion>& versions() const noexcept { return versions_; }
  // Facts about the node, its modules and commands to it; empty: the recording has none.
  [[nodiscard]] explain::Facts facts() const;
  [[nodiscard]] const std::vector<std::string>& modules() const noexcept { return modules_; }
  [[nodiscard]] const std::vector<std::string>& unknown_variables() const noexcept { return unknown_; }
  // Returns true if the recording was closed, not cut off.
  [[nodiscard]] bool complete() const noexcept { return reader_.contents().has_summary; }

 private:
  explicit RecordedRuns(recording::McapReader reader) : reader_(std::move(reader)) {}
  // The channel of a kind that holds no values.
  std::uint16_t& channel_of(recorder::ChannelKind kind) noexcept;
  Result<void, Unfit> match(const vars::Store& store, std::span<const schema::Variable> former,
                            const std::string& board, const std::string& name);

  recording::McapReader reader_;
  std::string prefix_;  // of names in the file
  std::string node_;
  std::vector<recorder::RecordedVersion> versions_;
  std::int64_t format_ = 1;
  std::int64_t real_minus_node_ns_ = 0;
  std::vector<std::string> modules_;
  std::map<std::uint16_t, std::uint32_t> variables_;  // by channel
  std::map<std::uint16_t, std::string> keyframes_;    // forms, by channel
  std::vector<std::string> unknown_;
  std::uint16_t runs_channel_ = 0;
  std::uint16_t clock_channel_ = 0;
  std::uint16_t answer_channel_ = 0;
  bool without_gaps_ = false;
  std::uint64_t time_ns_ = 0;
};

}  // namespace indurop::node

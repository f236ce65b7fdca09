// SPDX-License-Identifier: Apache-2.0
// Writes what the modules of a replay produce, as a recording to compare with the replayed one: the same names, the
// same times.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "history/recording/mcap_writer.h"
#include "store/vars/store.h"

namespace indurop::node {

class ReplayOutput {
 public:
  // `of`: the recording that is replayed. Errors: a file of this name exists already; it cannot be written.
  static Result<ReplayOutput, base::Problem> create(const std::filesystem::path& path, const std::string& of);

  // Adds the result of a run; an unchanged value is not written again. Errors: those of the disk.
  Result<void, base::Problem> take(std::uint32_t index, const schema::Variable& variable,
                                   const std::vector<std::uint8_t>& cdr, std::int64_t time_ns);
  // `differing`: number of runs that wrote another value than the recorded one, by variable.
  Result<void, base::Problem> close(const std::map<std::string, std::uint64_t>& differing);

 private:
  explicit ReplayOutput(recording::McapWriter writer) : writer_(std::move(writer)) {}

  struct Signal {
    std::uint16_t channel = 0;
    std::uint32_t count = 0;
    std::vector<std::uint8_t> last;
  };
  Result<std::uint16_t, base::Problem> channel_for(const schema::Variable& variable);

  recording::McapWriter writer_;
  std::map<std::string, std::uint16_t> schemas_;
  std::map<std::uint32_t, Signal> signals_;
};

}  // namespace indurop::node

// SPDX-License-Identifier: Apache-2.0
// A summary of a recording: its channels, its modules and their runs, and what is missing.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/base/problem.h"
#include "history/recorder/sources.h"

namespace indurop::recorder {

struct SurveyedModule {
  std::size_t source = 0;
  std::string name;
  std::uint64_t runs = 0;
  std::uint64_t lost = 0;    // overwritten before they were read, or in a damaged part
  std::uint64_t before = 0;  // runs before the first one in the recording
  std::uint64_t faults = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
};

struct SurveyedChannel {
  std::string name;
  std::string type;
  std::string unit;
  std::uint64_t messages = 0;
  std::uint64_t dropped = 0;  // lost runs of modules that write it: as many changes may be missing
};

struct Survey {
  Sources sources;
  std::vector<SurveyedModule> modules;
  std::vector<SurveyedChannel> channels;
  std::vector<std::string> attachments;
  std::vector<std::string> damages;
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
  std::int64_t begin_ns = 0;  // CLOCK_REALTIME, or virtual time of a simulation
  std::int64_t end_ns = 0;
  bool closed = false;
};

// Reads the whole file. Errors: it is no MCAP file; damaged parts are skipped and reported.
Result<Survey, base::Problem> survey(const std::filesystem::path& file);

}  // namespace indurop::recorder

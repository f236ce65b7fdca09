// SPDX-License-Identifier: Apache-2.0
// What a recording holds, counted: its channels, its modules and their runs, what is missing in it.

#pragma once

#include <indurop/result.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/problem.h"
#include "recorder/sources.h"

namespace indurop::recorder {

struct SurveyedModule {
  std::size_t source = 0;
  std::string name;
  std::uint64_t runs = 0;
  std::uint64_t lost = 0;    // that were overwritten before they were read, or are in a damaged part
  std::uint64_t before = 0;  // that were before the first one here
  std::uint64_t faults = 0;
  std::uint64_t first_tick = 0;
  std::uint64_t last_tick = 0;
};

struct SurveyedChannel {
  std::string name;
  std::string type;
  std::string unit;
  std::uint64_t messages = 0;
  std::uint64_t dropped = 0;  // lost runs of modules that tell it: so often it may have changed unseen
};

struct Survey {
  Sources sources;
  std::vector<SurveyedModule> modules;
  std::vector<SurveyedChannel> channels;
  std::vector<std::string> attachments;
  std::vector<std::string> damages;
  std::uint64_t bytes = 0;
  std::uint64_t messages = 0;
  std::int64_t begin_ns = 0;  // CLOCK_REALTIME, virtual time of a simulation
  std::int64_t end_ns = 0;
  bool closed = false;
};

// Reads all of it. Errors: it is no MCAP file; what is damaged inside is passed over and told.
Result<Survey, base::Problem> survey(const std::filesystem::path& file);

}  // namespace indurop::recorder

// SPDX-License-Identifier: Apache-2.0
// The statistics of a run: as JSON file (docs/report.md, stable) and as a table for users.

#pragma once

#include <indurop/result.h>

#include <filesystem>
#include <string>

#include "core/base/problem.h"
#include "scheduler/run_block.h"

namespace indurop::node {

std::string report_json(const scheduler::RunBlock& run);
// The file is written completely or not at all.
Result<void, base::Problem> write_report(const scheduler::RunBlock& run, const std::filesystem::path& file);
std::string summary_table(const scheduler::RunBlock& run);

}  // namespace indurop::node

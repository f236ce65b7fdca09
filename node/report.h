// SPDX-License-Identifier: Apache-2.0
// The statistics of a run: as JSON file (docs/report.md, stable) and as a table for people.

#pragma once

#include <filesystem>
#include <string>

#include "scheduler/run_block.h"

namespace indurop::node {

std::string report_json(const scheduler::RunBlock& run);
// False: `problem` says why. The file is written whole or not at all.
bool write_report(const scheduler::RunBlock& run, const std::filesystem::path& file, std::string& problem);
std::string summary_table(const scheduler::RunBlock& run);

}  // namespace indurop::node

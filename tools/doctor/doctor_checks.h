// SPDX-License-Identifier: Apache-2.0
// What of this machine matters to a control loop: each finding with a grade and what to do about it. Only looks and
// tries; changes nothing that lasts.

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace indurop::tools {

enum class Grade { Ok, Warn, Fail };

struct Finding {
  std::string name;  // stable, for JSON: "kernel", "clock-source"
  Grade grade = Grade::Ok;
  std::string found;
  std::string advice;  // empty if there is nothing to do
};

// All but the latency test. `root` is put before /proc, /sys and /dev of what is only read (tests use a copy).
std::vector<Finding> examine_machine(const std::filesystem::path& root = "/");

// Grade of a wake-up test: late by `p99_ns` in 99 %, `max_ns` at worst.
Finding grade_latency(std::int64_t p50_ns, std::int64_t p99_ns, std::int64_t max_ns, std::uint64_t wakeups,
                      bool real_time);

const char* to_text(Grade grade) noexcept;

}  // namespace indurop::tools

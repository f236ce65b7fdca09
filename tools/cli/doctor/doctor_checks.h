// SPDX-License-Identifier: Apache-2.0
// Checks what matters to a control loop on this machine: each finding has a grade and advice. Only reads and probes;
// makes no lasting change.

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

// Does all checks except the latency test. `root` is put before /proc, /sys and /dev for what is only read (tests use a
// copy).
std::vector<Finding> examine_machine(const std::filesystem::path& root = "/");

// Grades a wake-up test: `p99_ns` is the lateness that 99 % do not exceed, `max_ns` the maximum.
Finding grade_latency(std::int64_t p50_ns, std::int64_t p99_ns, std::int64_t max_ns, std::uint64_t wakeups,
                      bool real_time);

const char* to_text(Grade grade) noexcept;

}  // namespace indurop::tools

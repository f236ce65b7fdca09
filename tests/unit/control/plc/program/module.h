// SPDX-License-Identifier: Apache-2.0
// A compiled PLC program, run scan by scan on a clock of the test. Its shared variables are this process' own.

#pragma once

#include <chrono>
#include <string>

namespace indurop::testing {

class PlcModule {
 public:
  // `name` without folder and ending.
  explicit PlcModule(const std::string& name);
  ~PlcModule();
  PlcModule(const PlcModule&) = delete;
  PlcModule& operator=(const PlcModule&) = delete;

  // One scan at the given time.
  void scan(std::chrono::nanoseconds at = {}) const;
  // The text of the fault that ends the scan; "" if none does.
  [[nodiscard]] std::string fault() const;
  // Of one that an event starts: whether it has occurred.
  [[nodiscard]] bool due() const;

 private:
  void* library_ = nullptr;
  void (*run_)() = nullptr;
  bool (*condition_)() = nullptr;
};

}  // namespace indurop::testing

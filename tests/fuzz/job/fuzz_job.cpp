// SPDX-License-Identifier: Apache-2.0
// Any text is either a job that can be stepped or an error with its place, never a crash. Its layout is found at once.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "control/robot/job/format.h"
#include "control/robot/job/job.h"
#include "control/robot/job/runner.h"

namespace {

class Nothing final : public indurop::robot::Signals, public indurop::robot::MotionPort {
 public:
  double read(std::size_t /*index*/) noexcept override { return 1; }
  void write(std::size_t /*index*/, double /*value*/) noexcept override {}
  [[nodiscard]] bool ready() const noexcept override { return true; }
  [[nodiscard]] bool settled() const noexcept override { return true; }
  indurop::robot::Fault move(const indurop::robot::MoveCommand& /*command*/) noexcept override { return {}; }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const indurop::robot::JobFile file{"a.job", {reinterpret_cast<const char*>(data), size}};
  const std::string formatted = indurop::robot::format_job(file);
  if (indurop::robot::format_job({"a.job", formatted}) != formatted) {
    std::abort();
  }
  const auto [book, errors] = indurop::robot::parse_jobs({file});
  for (const indurop::base::Diagnostic& error : errors) {
    if (error.file != "a.job" || error.place.line == 0) {
      std::abort();
    }
  }
  if (errors.empty()) {
    indurop::robot::JobRunner runner(book);
    Nothing port;
    runner.start(0);
    for (int i = 0; i < 10; ++i) {
      runner.step(0.01, port, port);
    }
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "node/modules/retainer.h"

#include <algorithm>
#include <cstring>
#include <optional>
#include <string>

#include "core/rt/clock.h"
#include "core/rt/copy_text.h"
#include "node/run/ending.h"
#include "store/vars/layout.h"

namespace indurop::node {
namespace {

constexpr std::chrono::seconds kSaveEvery{1};
constexpr std::chrono::milliseconds kRetainPoll{20};

}  // namespace

Retainer::Retainer(vars::Store& store, const std::string& node) : store_(store), file_(vars::state_directory(node)) {
  const auto variables = store_.directory();
  any_ = std::any_of(variables.begin(), variables.end(),
                     [](const vars::DirectoryEntry& v) { return (v.flags & vars::kRetain) != 0; });
}

Retainer::~Retainer() {
  stop_.store(true);
  thread_.join();
}

void Retainer::load(Console& console, bool only_changed) {
  auto report = file_.load(store_, only_changed);
  if (!report) {
    console.error("retained variables could not be read: {}: {}; they start with their initial values",
                  report.error().where, std::strerror(report.error().sys_errno));
    return;
  }
  for (const std::string& note : report.value().notes) {
    console.warning("{}", note);
  }
  for (const std::string& one : report.value().lost) {
    console.warning("retained {}", one);
  }
  if (const std::string kept = report.value().kept_line(); !kept.empty()) {
    console.info("retained {}", kept);
  }
  if (report.value().restored > 0 && !only_changed) {
    console.info("{} retained variables restored", report.value().restored);
  }
}

void Retainer::start(scheduler::RunBlock& run, const Console& console) {
  if (!any_) {
    return;
  }
  auto thread = rt::Thread::start({"irp-retain", 0, -1}, [this, &run, &console] { loop(run, console); });
  if (thread) {
    thread_ = std::move(thread).value();
  }
}

void Retainer::loop(scheduler::RunBlock& run, const Console& console) {
  rt::MonoTime next = rt::MonoClock::now() + kSaveEvery;
  std::optional<rt::MonoTime> failing_since;
  while (!stop_.load()) {
    rt::sleep_until(rt::MonoClock::now() + kRetainPoll);
    const rt::MonoTime now = rt::MonoClock::now();
    if (now < next) {
      continue;
    }
    const Status saved = file_.save(store_);
    if (!saved && !failing_since) {
      failing_since = now;
      const std::string why = describe(saved.error());
      rt::copy_text(run.unsaved, why);
      console.error("retained variables cannot be saved: {}; the node tries again every second", why);
    } else if (saved && failing_since) {
      rt::copy_text(run.unsaved, "");
      console.warning("retained variables are saved again, after {} s",
                      std::chrono::round<std::chrono::seconds>(now - *failing_since).count());
      failing_since.reset();
    }
    next = rt::MonoClock::now() + kSaveEvery;
  }
}

bool Retainer::stop(const Console& console) {
  stop_.store(true);
  thread_.join();
  if (!any_) {
    return true;
  }
  const Status saved = file_.save(store_);
  if (!saved) {
    console.error("retained variables could not be saved: {}", describe(saved.error()));
  }
  return saved.ok();
}

}  // namespace indurop::node

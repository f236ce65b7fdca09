// SPDX-License-Identifier: Apache-2.0
#include "node/modules/retainer.h"

#include <algorithm>
#include <cstring>

#include "core/rt/clock.h"
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

void Retainer::start() {
  if (!any_) {
    return;
  }
  auto thread = rt::Thread::start({"irp-retain", 0, -1}, [this] { loop(); });
  if (thread) {
    thread_ = std::move(thread).value();
  }
}

void Retainer::loop() {
  rt::MonoTime next = rt::MonoClock::now() + kSaveEvery;
  while (!stop_.load()) {
    rt::sleep_until(rt::MonoClock::now() + kRetainPoll);
    if (rt::MonoClock::now() >= next) {
      const Status saved = file_.save(store_);
      failed_.store(static_cast<int>(saved.error().code));
      next = rt::MonoClock::now() + kSaveEvery;
    }
  }
}

bool Retainer::stop(Console& console) {
  stop_.store(true);
  thread_.join();
  if (!any_) {
    return true;
  }
  const Status saved = file_.save(store_);
  if (!saved) {
    console.error("retained variables could not be saved: {}", describe(saved.error()));
  } else if (failed_.load() != 0) {
    console.warning("an earlier save of the retained variables failed; the last one succeeded");
  }
  return saved.ok();
}

}  // namespace indurop::node

// SPDX-License-Identifier: Apache-2.0
#include "node/module_orders.h"

#include <algorithm>

#include "rt/clock.h"

namespace indurop::node {
namespace {

using scheduler::ModuleOrder;
using scheduler::ModuleState;
using scheduler::Operation;
using scheduler::OrderResult;

constexpr std::int64_t kLaunchNs = 5'000'000'000;  // until a process is ready to be released
constexpr std::int64_t kLookNs = 1'000'000;

}  // namespace

bool ModuleOrders::is_process(std::uint32_t module) const noexcept {
  return parts_.config.modules[module].type == scheduler::ModuleType::Process;
}

bool ModuleOrders::answer(const Work& work, OrderResult result) {
  const char* done = work.order == ModuleOrder::Stop ? "stopped" : "started";
  if (result == OrderResult::Done) {
    parts_.console.info("module {}: {} by order", record(work.module).name, done);
  } else if (result == OrderResult::Failed) {
    parts_.console.error("module {}: could not be {} as ordered", record(work.module).name, done);
  }
  scheduler::answer_order(record(work.module), result);
  return true;
}

void ModuleOrders::look(std::int64_t now_ns) {
  for (std::uint32_t i = 0; i < parts_.run.module_count; ++i) {
    const ModuleOrder order = scheduler::waiting_order(record(i));
    const bool taken = std::any_of(works_.begin(), works_.end(), [i](const Work& work) { return work.module == i; });
    if (order != ModuleOrder::None && !taken) {
      take(i, order, now_ns);
    }
  }
  std::erase_if(works_, [&](Work& work) { return go_on(work, now_ns); });
}

void ModuleOrders::take(std::uint32_t module, ModuleOrder order, std::int64_t now_ns) {
  const ModuleState state = record(module).state.load();
  const bool stopped = state == ModuleState::Stopped;
  const bool runs = state == ModuleState::Running || state == ModuleState::Starting;
  Work work{module, order, Step::Leaving, now_ns, {nullptr, [](Phases::Call* /*none*/) {}}};
  if ((order == ModuleOrder::Stop && stopped) || (order == ModuleOrder::Start && runs)) {
    scheduler::answer_order(record(module), OrderResult::Unchanged);
    return;
  }
  if (!stopped) {
    leave(work, now_ns);
  } else if (begin_start(work, now_ns)) {
    return;
  }
  works_.push_back(std::move(work));
}

bool ModuleOrders::go_on(Work& work, std::int64_t now_ns) {
  switch (work.step) {
    case Step::Leaving:
      return has_left(work, now_ns) && call_stop(work, now_ns);
    case Step::Stopping:
      if (!parts_.phases.ended(*work.call, now_ns, Phases::kGraceNs)) {
        return false;
      }
      (void)parts_.phases.conclude(std::move(work.call));  // that it failed is said; stopped it is all the same
      return rest(work, now_ns);
    case Step::Starting:
      return parts_.phases.ended(*work.call, now_ns, 0) &&
             (parts_.phases.conclude(std::move(work.call)) ? enter(work) : answer(work, OrderResult::Failed));
    case Step::Launching:
      return launched(work, now_ns);
  }
  return true;
}

void ModuleOrders::leave(const Work& work, std::int64_t now_ns) {
  if (is_process(work.module)) {
    parts_.processes.stop(work.module, now_ns);
  } else if (!parts_.engine.disable(work.module)) {
    parts_.normal_threads.halt(work.module, now_ns);
  }
}

bool ModuleOrders::has_left(const Work& work, std::int64_t now_ns) {
  return parts_.processes.has_ended(work.module) && parts_.engine.at_rest(work.module) &&
         parts_.normal_threads.has_ended(work.module, now_ns);
}

// No run of it is in progress any more: stop() follows.
bool ModuleOrders::call_stop(Work& work, std::int64_t now_ns) {
  record(work.module).state.store(ModuleState::Stopped);
  if (auto* stop = parts_.libraries[work.module].functions().stop; stop != nullptr) {
    work.call = parts_.phases.begin(work.module, "stop", stop);
    work.step = Step::Stopping;
  }
  return work.call == nullptr && rest(work, now_ns);
}

// The last word is with the values declared for the case that it is gone.
bool ModuleOrders::rest(Work& work, std::int64_t now_ns) {
  record(work.module).state.store(ModuleState::Stopped);
  parts_.failsafe.apply(work.module);
  return work.order == ModuleOrder::Stop ? answer(work, OrderResult::Done) : begin_start(work, now_ns);
}

bool ModuleOrders::begin_start(Work& work, std::int64_t now_ns) {
  work.began_ns = now_ns;
  if (is_process(work.module)) {
    work.step = Step::Launching;
    return !parts_.processes.start(work.module) && answer(work, OrderResult::Failed);
  }
  auto* start = parts_.libraries[work.module].functions().start;
  if (start == nullptr) {
    return enter(work);
  }
  work.call = parts_.phases.begin(work.module, "start", start);
  work.step = Step::Starting;
  return work.call == nullptr && answer(work, OrderResult::Failed);
}

bool ModuleOrders::enter(Work& work) {
  if (parts_.config.modules[work.module].operation == Operation::NonReal) {
    return answer(work, parts_.normal_threads.launch(work.module) ? OrderResult::Done : OrderResult::Failed);
  }
  record(work.module).state.store(ModuleState::Running);
  parts_.engine.enable(work.module);
  return answer(work, OrderResult::Done);
}

bool ModuleOrders::launched(Work& work, std::int64_t now_ns) {
  switch (record(work.module).state.load()) {
    case ModuleState::Running:
    case ModuleState::Exited:
      return answer(work, OrderResult::Done);
    case ModuleState::Restarting:
    case ModuleState::Faulted:
      return answer(work, OrderResult::Failed);
    case ModuleState::Loaded:
    case ModuleState::Starting:
    case ModuleState::Stopped:
      break;
  }
  return now_ns - work.began_ns > kLaunchNs && answer(work, OrderResult::Failed);
}

void ModuleOrders::end() {
  for (Work& work : works_) {
    if (work.call != nullptr) {
      while (!parts_.phases.ended(*work.call, rt::now_ns(), Phases::kGraceNs)) {
        rt::sleep_until(rt::now_ns() + kLookNs);
      }
      if (parts_.phases.conclude(std::move(work.call)) && work.step == Step::Starting) {
        record(work.module).state.store(ModuleState::Loaded);  // it has started, so it gets its stop()
      }
    }
    scheduler::answer_order(record(work.module), OrderResult::Ending);
  }
  works_.clear();
}

}  // namespace indurop::node

// SPDX-License-Identifier: Apache-2.0
#include "node/exchange/retired.h"

#include <utility>

#include "core/rt/clock.h"
#include "store/runtime/host.h"

namespace indurop::node {
namespace {

constexpr std::chrono::milliseconds kRetiredPoll{1};

}  // namespace

void Retired::add(std::uint32_t module, ModuleLibrary&& library) {
  One one{module, std::move(library), {nullptr, [](Phases::Call* /*none*/) {}}};
  if (auto* stop = one.library.functions().stop; stop != nullptr) {
    runtime::bind_apart(one.library.inside());
    one.call = phases_.begin(module, "stop", stop);
  }
  if (one.call == nullptr) {
    unload(one);
  } else {
    all_.push_back(std::move(one));
  }
}

void Retired::abandon(std::uint32_t module, ModuleLibrary&& library) {
  library.abandon();
  count(module, "a fault ended it");
}

void Retired::count(std::uint32_t module, const std::string& why) {
  scheduler::ModuleRecord& record = run_.modules()[module];
  const std::uint32_t kept = record.kept_loaded.fetch_add(1) + 1;
  console_.warning("module {}: a version that runs no more stays in memory, because {} ({} in all)", record.name, why,
                   kept);
}

void Retired::unload(One& one) {
  if (!one.library.unload()) {
    count(one.module, "the dynamic linker keeps it (unique symbols, or thread_local objects)");
  }
}

void Retired::poll(rt::MonoTime now) {
  std::erase_if(all_, [&](One& one) {
    if (!phases_.ended(*one.call, now, Phases::kGrace)) {
      return false;
    }
    if (const auto failure = Phases::failure_of(std::move(one.call))) {
      console_.warning("module {}: of the previous version, {}", run_.modules()[one.module].name, *failure);
      abandon(one.module, std::move(one.library));
    } else {
      unload(one);
    }
    return true;
  });
}

void Retired::end() {
  while (!all_.empty()) {
    poll(rt::MonoClock::now());
    rt::sleep_until(rt::MonoClock::now() + kRetiredPoll);
  }
}

}  // namespace indurop::node

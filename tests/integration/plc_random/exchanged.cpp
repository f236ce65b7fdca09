// SPDX-License-Identifier: Apache-2.0
// exchanged FILE TICKS SEED: runs a thread module in virtual time and prints, after each tick, a hash of all that it
// keeps. With a SEED its code is exchanged in random ticks with another copy of the file, forth, back and forth again.
// Prints the number of exchanges on stderr.
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "node/exchange/carry.h"
#include "node/modules/module_library.h"
#include "scheduler/engine.h"
#include "store/runtime/host.h"
#include "tests/unit/scheduler/fixture.h"

namespace {

using indurop::node::ModuleLibrary;
using indurop::scheduler::Engine;
using indurop::scheduler::Exchange;

constexpr std::int64_t kPeriodNs = 10'000'000;
constexpr std::int64_t kBeginNs = 2'000'000'000;

ModuleLibrary load(const char* file) {
  ModuleLibrary library;
  if (const auto loaded = library.load(file, true); !loaded) {
    std::fprintf(stderr, "%s\n", loaded.error().text.c_str());
    std::exit(2);
  }
  if (library.functions().start != nullptr) {
    library.functions().start();
  }
  return library;
}

std::uint64_t hash_of(const ModuleLibrary& library) {
  std::uint64_t hash = 0;
  for (const auto& item : library.memory().items()) {
    if (item.kind != indurop::node::ModuleMemory::Kind::Value) {
      continue;  // addresses differ from one copy to the next
    }
    hash = hash * 31 + indurop::abi::fnv1a64(static_cast<const char*>(item.address), item.size);
  }
  return hash;
}

class Plant {
 public:
  explicit Plant(const char* file) : file_(file), running_(load(file)) {
    const auto task = indurop::scheduler::periodic(0, kPeriodNs, 1, running_.functions().run);
    block_ = indurop::scheduler::make_block({task}, kPeriodNs, kPeriodNs);
    indurop::scheduler::EngineSettings settings;
    settings.basic_period_ns = kPeriodNs;
    settings.realtime = false;
    indurop::scheduler::Hooks hooks;
    hooks.entering = [](void*, std::uint32_t module, std::uint64_t tick, std::int64_t release_ns) noexcept {
      indurop::runtime::set_current_run(module, {tick, release_ns});
    };
    engine_ = std::make_unique<Engine>(*block_, std::span(&task, 1), settings, hooks, clock_);
  }

  void step() {
    clock_.sleep_until(indurop::rt::mono_time(kBeginNs + static_cast<std::int64_t>(tick_) * kPeriodNs));
    engine_->step(tick_++, indurop::rt::mono_time(kBeginNs));
    std::printf("%llu %016llx\n", static_cast<unsigned long long>(block_->modules()[0].runs.load()),
                static_cast<unsigned long long>(hash_of(running_)));
  }

  // Begins an exchange; it happens with the next step. Returns false if what the module keeps cannot be taken now.
  bool begin() {
    other_ = load(file_);
    auto carry = indurop::node::plan_carry(running_.memory(), other_.memory());
    if (!carry.plan.with_state || carry.loses) {
      std::fprintf(stderr, "it cannot be exchanged: %s\n", carry.plan.why_not.c_str());
      std::exit(3);
    }
    if (carry.between_runs && !copy_between_runs()) {
      other_.unload();
      return false;
    }
    Exchange::Settings settings;
    settings.next.run = other_.functions().run;
    settings.pairs = std::move(carry.pairs);
    settings.offered = carry.between_runs;
    settings.can_return = !carry.between_runs;
    exchange_.emplace(std::move(settings));
    (void)engine_->watch(0, *exchange_);
    if (carry.between_runs) {
      exchange_->offer(exchange_->gap().value());
    }
    std::swap(running_, other_);
    return true;
  }
  void go_back() {
    if (exchange_->go_back(Exchange::Reason::Command)) {
      std::swap(running_, other_);
    }
  }
  void end() {
    (void)engine_->unwatch(0);
    other_.unload();
  }
  [[nodiscard]] bool faulted() const {
    return block_->modules()[0].state.load() == indurop::scheduler::ModuleState::Faulted;
  }

 private:
  bool copy_between_runs() {
    std::vector<std::byte> bytes(running_.memory().most());
    const std::size_t size = running_.memory().save(bytes);
    const std::span kept(reinterpret_cast<const std::uint8_t*>(bytes.data()), size);
    if (size > 0 && !other_.memory().restore(running_.memory().form(), kept).empty()) {
      std::fprintf(stderr, "a copy of the module keeps something else\n");
      std::exit(3);
    }
    return size > 0;
  }

  const char* file_;
  ModuleLibrary running_;
  ModuleLibrary other_;
  indurop::scheduler::VirtualClock clock_;
  indurop::scheduler::BlockPointer block_;
  std::unique_ptr<Engine> engine_;
  std::optional<Exchange> exchange_;
  std::uint64_t tick_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    return 2;
  }
  const int ticks = std::atoi(argv[2]);
  std::mt19937 random(static_cast<unsigned>(std::atoi(argv[3])));
  const bool exchanges = std::atoi(argv[3]) != 0;
  Plant plant(argv[1]);
  int count = 0;
  for (int tick = 0; tick < ticks && !plant.faulted(); ++tick) {
    if (!exchanges || random() % 4 != 0 || tick + 3 >= ticks) {
      plant.step();
      continue;
    }
    if (!plant.begin()) {
      plant.step();
      continue;
    }
    plant.step();
    ++count;
    if (random() % 3 == 0) {
      plant.go_back();
      plant.step();
      ++tick;
      ++count;
    }
    plant.end();
  }
  std::fprintf(stderr, "%d\n", count);
  return 0;
}

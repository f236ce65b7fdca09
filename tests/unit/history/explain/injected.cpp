// SPDX-License-Identifier: Apache-2.0
#include "injected.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "history/explain/run_facts.h"
#include "history/explain/timeline.h"
#include "scheduler/simulated_kernel.h"
#include "tests/unit/scheduler/fixture.h"

namespace indurop::explain {
namespace {

using scheduler::Task;
using What = Injection::What;

struct World {
  const Injection* injection = nullptr;
  scheduler::SimulatedKernel* kernel = nullptr;
  scheduler::RunBlock* block = nullptr;
  std::uint32_t running = 0;
  std::int64_t due_ns = 0;  // of the injection
  bool done = false;
  std::int64_t done_ns = 0;  // when a page came from the disk
};
World* g_world = nullptr;

bool is_time() {
  return !g_world->done && rt::to_ns(g_world->kernel->now()) >= g_world->due_ns;
}

void run_module() {
  World& world = *g_world;
  if (world.running != world.injection->module || !is_time()) {
    return;
  }
  if (world.injection->what == What::Longer || world.injection->what == What::PageFault) {
    world.done = true;
    world.done_ns = rt::to_ns(world.kernel->now());
    world.kernel->work(world.injection->for_ns);
  } else if (world.injection->what == What::Throws) {
    world.done = true;
    throw std::runtime_error("injected");
  }
}

void connect(std::vector<Task>& tasks) {
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (std::size_t k = 0; k < tasks.size(); ++k) {
      const bool earlier = tasks[k].priority < tasks[i].priority || (tasks[k].priority == tasks[i].priority && k < i);
      const bool timed =
          tasks[k].operation == scheduler::Operation::Periodic && tasks[i].operation == scheduler::Operation::Periodic;
      if (earlier && timed && tasks[k].core != tasks[i].core && (i + k) % 2 == 0) {
        tasks[i].after.push_back(static_cast<std::uint32_t>(k));
      }
    }
  }
}

// A module that takes longer lets threads of lower priority wait; the kernel counts it when they run at last.
void add_those_below(Facts& facts, const Injection& injection, std::int64_t due_ns) {
  const ModuleFact& longer = facts.modules[injection.module];
  KernelFact fact;
  fact.from_ns = due_ns + injection.for_ns / 2;
  fact.to_ns = due_ns + injection.for_ns + 20 * kBasic;
  fact.core = longer.core;
  fact.waited_ns = injection.for_ns;
  fact.thread = "irp-events";
  facts.kernel.push_back(fact);
  for (const ModuleFact& module : facts.modules) {
    if (module.core == longer.core && module.fifo_priority > 0 && module.fifo_priority < longer.fifo_priority) {
      fact.thread = "irp-band-" + std::to_string(module.fifo_priority);
      facts.kernel.push_back(fact);
    }
  }
}

// As the node reads the kernel's counters: every 20 ms, by core.
void add_kernel(Facts& facts, const Injection& injection, std::int32_t its_core, std::int64_t due_ns) {
  constexpr std::int64_t kLook = 20 * kBasic;
  const Span stood{due_ns - 1000, due_ns - 1000 + (injection.what == What::MachineStands ? injection.for_ns : 0)};
  facts.kernel_from_ns = facts.epoch_ns - kLook / 3;
  facts.kernel_to_ns = facts.epoch_ns + 200 * kBasic;
  for (std::int64_t from = facts.kernel_from_ns; from < facts.epoch_ns + 200 * kBasic; from += kLook) {
    for (const std::int32_t core : {0, 1}) {
      KernelFact fact;
      fact.from_ns = from;
      fact.to_ns = from + kLook;
      fact.core = core;
      fact.thread = "irp-tick-0";
      fact.waited_ns =
          core == 0 ? Span{std::max(from, stood.from_ns), std::min(from + kLook, stood.to_ns)}.length() : 0;
      const std::int64_t paged = g_world->done_ns;
      fact.major_faults = injection.what == What::PageFault && core == its_core && from <= paged && paged < fact.to_ns;
      if (fact.waited_ns > 0 || fact.major_faults > 0) {
        facts.kernel.push_back(fact);
      }
    }
  }
}

Facts facts_after(const scheduler::RunBlock& block, const std::vector<Task>& tasks, const Injection& injection,
                  std::int64_t due_ns) {
  Facts facts = facts_of(block, block.total_size, true);
  facts.is_virtual = false;
  facts.realtime = true;
  add_kernel(facts, injection, tasks[injection.module].core, due_ns);
  if (injection.what == What::Longer) {
    add_those_below(facts, injection, due_ns);
  }
  facts.board = "here";
  facts.now_ns = rt::to_ns(g_world->kernel->now());
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    for (const std::uint32_t other : tasks[i].after) {
      facts.modules[i].after.push_back(facts.modules[other].name);
    }
  }
  if (injection.what == What::Stopped) {
    facts.orders.push_back(
        {due_ns - kBasic / 2, 0, injection.by, "pc4", "stop", "m" + std::to_string(injection.module), {}, 0, {}});
  }
  return facts;
}

}  // namespace

std::vector<Task> random_schedule(Random& random) {
  const int count = random.upto(3, 7);
  const int cores = random.upto(1, 2);
  std::vector<Task> tasks;
  for (int i = 0; i < count; ++i) {
    Task task = scheduler::periodic(static_cast<std::uint32_t>(i), kBasic, random.upto(1, 9), run_module);
    task.period_ns = kBasic * std::array{1, 1, 2, 5, 10}.at(static_cast<std::size_t>(random.upto(0, 4)));
    task.work_ns = task.period_ns / (2 * count) * random.upto(30, 100) / 100;
    task.core = random.upto(0, cores - 1);
    tasks.push_back(task);
  }
  Task event = scheduler::periodic(static_cast<std::uint32_t>(count), 0, random.upto(1, 9), run_module);
  event.operation = scheduler::Operation::Sporadic;
  event.after_base = true;
  event.condition = +[]() -> bool {
    World& world = *g_world;
    const bool now = world.injection->what == What::Event && is_time();
    world.done = world.done || now;
    return now;
  };
  tasks.push_back(event);
  connect(tasks);
  return tasks;
}

Facts run_schedule(const std::vector<Task>& given, const Injection& injection) {
  std::vector<Task> tasks = given;
  if (injection.what == What::Event) {
    tasks.back().work_ns = injection.for_ns;
  }
  const scheduler::BlockPointer block = scheduler::make_block(tasks, kBasic, 10 * kBasic);
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    block->modules()[i].core = tasks[i].core;
    block->modules()[i].state.store(scheduler::ModuleState::Running);
  }
  World world;
  world.injection = &injection;
  world.block = block.get();
  g_world = &world;
  scheduler::EngineSettings settings;
  settings.basic_period_ns = kBasic;
  settings.spin.mode = scheduler::SpinMode::Off;
  settings.order = scheduler::CoreOrder::Data;
  scheduler::Hooks hooks;
  hooks.context = &world;
  hooks.entering = [](void* context, std::uint32_t module, std::uint64_t, std::int64_t) noexcept {
    static_cast<World*>(context)->running = module;
  };
  scheduler::SimulatedKernel kernel(rt::mono_time(kBasic), {}, {});
  world.kernel = &kernel;
  scheduler::Engine engine(*block, tasks, settings, hooks, kernel);
  EXPECT_TRUE(engine.start(kTicks).ok());
  world.due_ns = block->epoch_ns + static_cast<std::int64_t>(injection.tick) * kBasic;
  std::unique_ptr<scheduler::KernelThread> machine;
  if (injection.what == What::MachineStands) {
    rt::ThreadSettings highest;
    highest.fifo_priority = 99;
    highest.core = 0;
    machine = kernel
                  .start(highest,
                         [&] {
                           kernel.sleep_until(rt::mono_time(world.due_ns - 1000));
                           kernel.work(injection.for_ns);
                         })
                  .value();
  }
  if (injection.what == What::Stopped) {
    kernel.sleep_until(rt::mono_time(world.due_ns - kBasic / 2));
    EXPECT_TRUE(engine.disable(injection.module));
    block->modules()[injection.module].state.store(scheduler::ModuleState::Stopped);
  }
  engine.join();
  machine.reset();
  return facts_after(*block, tasks, injection, world.due_ns);
}

}  // namespace indurop::explain

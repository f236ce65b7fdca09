// SPDX-License-Identifier: Apache-2.0
// What the tape adds to a run of a module with so many variables of 16 bytes: all of them changed, none of them. The
// time of writing them is not counted.

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <chrono>
#include <cstring>
#include <string>
#include <vector>

#include "store/tape/tape.h"

namespace {

using namespace indurop;

schema::Schema many(std::size_t count) {
  schema::Type type;
  type.base = schema::Base::Double;
  type.element_size = schema::size_of(type.base);
  type.align = type.element_size;
  type.dims = {2};
  schema::Schema schema;
  for (std::size_t i = 0; i < count; ++i) {
    schema::Variable variable;
    variable.name = "v" + std::to_string(i);
    variable.type = type;
    variable.type_hash = schema::hash_of(type);
    schema.variables.push_back(variable);
  }
  return schema;
}

void run_on_tape(benchmark::State& state, bool change) {
  const auto count = static_cast<std::size_t>(state.range(0));
  const std::string node = "tape-bench-" + std::to_string(::getpid());
  auto store = vars::Store::create(node, many(count));
  tape::ModuleAccess access{0, 1'000'000, {}, {}};
  for (std::uint32_t i = 0; i < count; ++i) {
    access.writes.push_back(i);
  }
  const auto plan = tape::plan_tape({&access, 1}, store->directory(), 1'000'000, 2'000'000'000, 8'000'000);
  auto tape = tape::Tape::create(node, *store, plan, 1);
  tape::Track& track = *(*tape)->of(0);
  double value = 0;
  std::uint64_t tick = 0;
  for (auto _ : state) {
    value += 1;
    for (std::size_t i = 0; change && i < count; ++i) {
      const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
      (void)store->write(store->directory()[i], 0, {bytes, sizeof value});
    }
    const auto begin = std::chrono::steady_clock::now();
    track.begin();
    track.end({0, 0, tick++, 0, 0, 0}, 0);
    state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
  }
  tape->reset();
  store = vars::Store::create(node, {});
  (void)vars::remove_node(node);
}
void all_changed(benchmark::State& state) {
  run_on_tape(state, true);
}
void none_changed(benchmark::State& state) {
  run_on_tape(state, false);
}
BENCHMARK(all_changed)->Arg(0)->Arg(50)->Arg(1000)->UseManualTime();
BENCHMARK(none_changed)->Arg(0)->Arg(50)->Arg(1000)->UseManualTime();

}  // namespace

BENCHMARK_MAIN();

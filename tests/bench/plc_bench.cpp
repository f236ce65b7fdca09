// SPDX-License-Identifier: Apache-2.0
// What PLC programs cost: a scan of a thousand rungs, and a loop in Structured Text against the same loop by hand.

#include <indurop/module.h>

#include <benchmark/benchmark.h>
#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace {

using Run = void (*)();

Run scan_of(const char* file) {
  void* library = ::dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    std::fprintf(stderr, "%s\n", ::dlerror());
    std::exit(1);
  }
  indurop::ModuleDescriptor descriptor;
  reinterpret_cast<void (*)(indurop::ModuleDescriptor*)>(::dlsym(library, "indurop_module_describe"))(&descriptor);
  return descriptor.run;
}

void thousand_rungs(benchmark::State& state) {
  static const Run run = scan_of(PLC_MODULES "/bench_rungs.so");
  for (auto _ : state) {
    run();
  }
}
BENCHMARK(thousand_rungs);

// The same, telling `indurop plc watch` about all variables and the power in all rungs.
void thousand_rungs_watched(benchmark::State& state) {
  static const Run run = scan_of(PLC_MODULES "/bench_rungs_watched.so");
  for (auto _ : state) {
    run();
  }
}
BENCHMARK(thousand_rungs_watched);

void loop_in_st(benchmark::State& state) {
  static const Run run = scan_of(PLC_MODULES "/bench_loop.so");
  for (auto _ : state) {
    run();
  }
}

// bench_loop.st, line by line.
struct Loop {
  std::array<std::int32_t, 1000> list{};
  std::array<double, 1000> filtered{};
  std::int32_t sum = 0;
  std::int32_t largest = 0;
  double level = 0;
  std::int32_t seed = 1;

  [[gnu::noinline]] void run() {
    sum = 0;
    largest = 0;
    for (int i = 0; i < 1000; ++i) {
      seed = static_cast<std::int32_t>(static_cast<std::uint32_t>(seed) * 1103515245U + 12345U);
      list[static_cast<std::size_t>(i)] = seed / 65536;
    }
    for (int i = 0; i < 1000; ++i) {
      sum = static_cast<std::int32_t>(static_cast<std::uint32_t>(sum) +
                                      static_cast<std::uint32_t>(list[static_cast<std::size_t>(i)]));
      if (list[static_cast<std::size_t>(i)] > largest) {
        largest = list[static_cast<std::size_t>(i)];
      }
    }
    for (int i = 1; i < 1000; ++i) {
      filtered[static_cast<std::size_t>(i)] = filtered[static_cast<std::size_t>(i) - 1] * 0.9 +
                                              static_cast<double>(list[static_cast<std::size_t>(i)]) * 0.1;
    }
    level = filtered[999];
  }
};

void loop_by_hand(benchmark::State& state) {
  static Loop loop;
  for (auto _ : state) {
    loop.run();
    benchmark::DoNotOptimize(loop.level);
    benchmark::ClobberMemory();
  }
}

BENCHMARK(loop_in_st);
BENCHMARK(loop_by_hand);

}  // namespace

BENCHMARK_MAIN();

// SPDX-License-Identifier: Apache-2.0
// Shared variables in a store against raw globals: read and write of a scalar, 24 and 256 bytes.

#include <benchmark/benchmark.h>
#include <indurop/generated.h>
#include <indurop/indurop.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "core/schema/elf.h"
#include "core/schema/schema.h"
#include "store/vars/store.h"

namespace {

using Three = INDUROP_TYPEOF(bench::bytes24)::value_type;
using Many = INDUROP_TYPEOF(bench::bytes256)::value_type;

std::uint32_t raw_scalar = 0;
Three raw24;
Many raw256;

void raw_scalar_read(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(*static_cast<volatile std::uint32_t*>(&raw_scalar));
  }
}
void scalar_read(benchmark::State& state) {
  for (auto _ : state) {
    benchmark::DoNotOptimize(bench::scalar.get());
  }
}
void raw_scalar_write(benchmark::State& state) {
  std::uint32_t n = 0;
  for (auto _ : state) {
    *static_cast<volatile std::uint32_t*>(&raw_scalar) = ++n;
  }
}
void scalar_write(benchmark::State& state) {
  std::uint32_t n = 0;
  for (auto _ : state) {
    bench::scalar = ++n;
  }
}
void read_24(benchmark::State& state) {
  for (auto _ : state) {
    Three v = bench::bytes24;
    benchmark::DoNotOptimize(v);
  }
}
void raw_read_24(benchmark::State& state) {
  for (auto _ : state) {
    Three v = raw24;
    benchmark::DoNotOptimize(v);
    benchmark::ClobberMemory();
  }
}
void write_24(benchmark::State& state) {
  Three v;
  for (auto _ : state) {
    v.x += 1;
    bench::bytes24 = v;
  }
}
void read_256(benchmark::State& state) {
  for (auto _ : state) {
    Many v = bench::bytes256;
    benchmark::DoNotOptimize(v);
  }
}
void raw_read_256(benchmark::State& state) {
  for (auto _ : state) {
    Many v = raw256;
    benchmark::DoNotOptimize(v);
    benchmark::ClobberMemory();
  }
}
void write_256(benchmark::State& state) {
  Many v;
  for (auto _ : state) {
    v.v[0] += 1;
    bench::bytes256 = v;
  }
}

BENCHMARK(raw_scalar_read);
BENCHMARK(scalar_read);
BENCHMARK(raw_scalar_write);
BENCHMARK(scalar_write);
BENCHMARK(raw_read_24);
BENCHMARK(read_24);
BENCHMARK(write_24);
BENCHMARK(raw_read_256);
BENCHMARK(read_256);
BENCHMARK(write_256);

}  // namespace

int main(int argc, char** argv) {
  const auto file = indurop::schema::read_module_file("/proc/self/exe");
  if (!file) {
    return 1;
  }
  const auto schema = indurop::schema::from_json(file.value().schema_json);
  const std::string node = "bench" + std::to_string(::getpid());
  const auto store = indurop::vars::Store::create(node, schema.value());
  if (!store || irp::attach(node.c_str()) != 0) {
    std::fprintf(stderr, "cannot make a store\n");
    return 1;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return indurop::vars::remove_node(node).ok() ? 0 : 1;
}

// SPDX-License-Identifier: Apache-2.0
// A store of N numbers: how long until it is made, until another process has attached to it, and what writing all of
// them costs for each. Usage: growth_store N
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/schema/schema.h"
#include "store/vars/scalar.h"
#include "store/vars/store.h"

namespace {

double since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double, std::nano>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

int main(int argc, char** argv) {
  using namespace indurop;
  const int count = argc > 1 ? std::atoi(argv[1]) : 1;
  schema::Schema schema;
  for (int i = 0; i < count; ++i) {
    schema::Variable variable;
    variable.name = "growth::v" + std::to_string(i);
    variable.type.base = schema::Base::Double;
    variable.type.element_size = variable.type.align = schema::size_of(schema::Base::Double);
    variable.type_hash = schema::hash_of(variable.type);
    variable.kind = abi::Kind::Scalar;
    schema.variables.push_back(variable);
  }
  const std::string node = "growth" + std::to_string(::getpid());
  auto begin = std::chrono::steady_clock::now();
  const auto store = vars::Store::create(node, schema);
  const double created = since(begin);
  begin = std::chrono::steady_clock::now();
  const auto other = vars::Store::attach(node, vars::Mode::ReadWrite);
  const double attached = since(begin);
  if (!store || !other) {
    std::fprintf(stderr, "cannot make a store\n");
    return 1;
  }
  std::vector<void*> entries;
  for (const auto& variable : other->directory()) {
    entries.push_back(other->entry(variable.name_hash, 0));
  }
  constexpr int kRounds = 100;
  begin = std::chrono::steady_clock::now();
  for (int round = 0; round < kRounds; ++round) {
    for (void* const entry : entries) {
      __atomic_store_n(static_cast<std::int64_t*>(entry), round, __ATOMIC_RELEASE);
    }
  }
  const double written = since(begin) / kRounds;
  std::printf("{\"all written, us\": %.3f, \"made, ms\": %.3f, \"attached, ms\": %.3f, \"store, kB\": %.0f}\n",
              written / 1e3, created / 1e6, attached / 1e6, static_cast<double>(other->header().total_size) / 1e3);
  return vars::remove_node(node).ok() ? 0 : 1;
}

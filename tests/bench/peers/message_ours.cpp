// SPDX-License-Identifier: Apache-2.0
// A shared variable written and read.
#include <indurop/generated.h>
#include <indurop/indurop.h>
#include <unistd.h>

#include <cstdio>
#include <string>

#include "core/schema/elf.h"
#include "core/schema/schema.h"
#include "measure.h"
#include "store/vars/store.h"

namespace {

template <class Variable>
void exchange(Variable& variable, std::size_t bytes) {
  typename Variable::value_type message{};
  std::uint8_t count = 0;
  peers::measure(bytes, [&] {
    message.data[0] = ++count;
    variable = message;
    const typename Variable::value_type got = variable;
    return got.data[0] == count;
  });
}

}  // namespace

int main() {
  const auto file = indurop::schema::read_module_file("/proc/self/exe");
  if (!file) {
    return 1;
  }
  const auto schema = indurop::schema::from_json(file.value().schema_json);
  const std::string node = "peers" + std::to_string(::getpid());
  const auto store = indurop::vars::Store::create(node, schema.value());
  if (!store || irp::attach(node.c_str()) != 0) {
    std::fprintf(stderr, "cannot make a store\n");
    return 1;
  }
  exchange(peers::bytes64, 64);
  exchange(peers::bytes256, 256);
  exchange(peers::bytes4096, 4096);
  return indurop::vars::remove_node(node).ok() ? 0 : 1;
}

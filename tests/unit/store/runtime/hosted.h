// SPDX-License-Identifier: Apache-2.0
// This test process as the node's own process: attached to a TestNode for the life of the object.

#pragma once

#include "store/runtime/host.h"
#include "test_node.h"

namespace indurop::testing {

class Hosted {
 public:
  explicit Hosted(TestNode& node) : problems(runtime::attach_process(node.store(), node.run())) {
    runtime::set_current_module(0);
  }
  ~Hosted() {
    runtime::stop_function_servers();
    runtime::set_current_module(runtime::kNoModule);
    runtime::detach_process();
    (void)runtime::take_binding_errors();
  }
  Hosted(const Hosted&) = delete;
  Hosted& operator=(const Hosted&) = delete;

  std::vector<std::string> problems;
};

// Everything module 0 has printed since the last call.
inline std::string printed(TestNode& node) {
  runtime::MessageReader reader(node.run());
  runtime::Message message;
  std::string all;
  while (reader.next(message, {})) {
    all += message.text;
  }
  return all;
}

}  // namespace indurop::testing

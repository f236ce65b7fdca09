// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a PLC program holds: the compiler ends with modules or with messages, never with a crash. Inputs that
// begin with '<' are PLCopen XML, all others Structured Text.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "plc/front/compiler.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  indurop::plc::CompileOptions options;
  options.files = {text.starts_with('<') ? "in.xml" : "in.st"};
  options.name = "fuzzed";
  const auto compiled = indurop::plc::compile(options, [&](const std::string& name) {
    return indurop::glb2idl::ReadResult{text, name, ""};
  });
  const bool silent_failure = !compiled.ok && compiled.messages.empty();
  if (silent_failure || (compiled.ok && compiled.modules.empty())) {
    std::abort();
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
// Whatever bytes a .glb holds: the compiler ends with a program or with messages, never with a crash, and what it
// accepts it can emit and read back. A line "%file NAME" in the input begins another file that can be included.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <string>
#include <string_view>

#include "glb2idl/compiler.h"
#include "glb2idl/emit.h"

namespace {

using namespace indurop::glb2idl;

std::map<std::string, std::string> split(std::string_view input) {
  constexpr std::string_view kMark = "%file ";
  std::map<std::string, std::string> files;
  std::string name = "in.glb";
  while (!input.empty()) {
    const std::size_t end = std::min(input.find('\n'), input.size());
    const std::string_view line = input.substr(0, end);
    if (line.starts_with(kMark)) {
      name = std::string(line.substr(kMark.size())) + ".glb";
    } else {
      files[name].append(line).append(end < input.size() ? "\n" : "");
    }
    input.remove_prefix(std::min(end + 1, input.size()));
  }
  return files;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto files = split({reinterpret_cast<const char*>(data), size});
  const Compilation result = compile({"in.glb"}, [&files](const std::string& path) {
    const auto found = files.find(path);
    return found == files.end() ? ReadResult{std::nullopt, "", "there is no such file"}
                                : ReadResult{found->second, path, ""};
  });
  if (result.ok != result.diagnostics.empty()) {
    std::abort();
  }
  if (!result.ok) {
    return 0;
  }
  (void)emit_all(result.program);
  for (const GlbFile& unit : result.program.units) {
    if (!indurop::schema::from_json(indurop::schema::to_json(schema_of(unit))).ok()) {
      std::abort();
    }
  }
  return 0;
}

// SPDX-License-Identifier: Apache-2.0
#include "doors/fmi/contents/contents.h"

#include <cstdint>
#include <utility>

#include "core/base/json.h"

namespace indurop::fmi {
namespace {

constexpr std::uint64_t kFormat = 1;

}  // namespace

std::string to_text(const Contents& contents) {
  base::Json variables = base::Json::array();
  for (const FmuVariable& one : contents.variables) {
    variables.push_back({{"name", one.name}, {"boards", one.boards}, {"input", one.input}});
  }
  const base::Json whole{
      {"indurop_fmu", kFormat},  {"token", contents.token},       {"configuration", contents.configuration},
      {"plant", contents.plant}, {"programs", contents.programs}, {"executables", contents.executables},
      {"variables", variables}};
  return whole.dump_rows();
}

Result<Contents, base::Problem> read_contents(std::string_view text) {
  const base::Json whole = base::Json::parse(text).value_or(base::Json());
  const base::Problem damaged{std::string(kContentsName) + " in the resources of the FMU is damaged"};
  std::uint64_t format = 0;
  if (!read(whole, "indurop_fmu", format)) {
    return damaged;
  }
  if (format != kFormat) {
    return base::Problem{"the FMU was made by another version of InduRoP: make it again with indurop-fmu"};
  }
  Contents contents;
  if (!read(whole, "token", contents.token) || !read(whole, "configuration", contents.configuration) ||
      !read(whole, "plant", contents.plant) || !read(whole, "programs", contents.programs) ||
      !read(whole, "executables", contents.executables)) {
    return damaged;
  }
  for (const base::Json& each : whole["variables"].values()) {
    FmuVariable& one = contents.variables.emplace_back();
    if (!read(each, "name", one.name) || !read(each, "boards", one.boards) || !read(each, "input", one.input) ||
        one.boards.empty()) {
      return damaged;
    }
  }
  return contents;
}

}  // namespace indurop::fmi

// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_retained.h"

#include <fmt/format.h>

#include <map>

#include "core/schema/carry.h"
#include "glb2idl/compiler.h"

namespace indurop::tools {
namespace {

using Retained = std::map<std::string, schema::Variable>;

Retained retained_of(const glb2idl::Compilation& compiled) {
  Retained out;
  for (const glb2idl::GlbFile& unit : compiled.program.units) {
    for (const schema::Variable& one : schema_of(unit).variables) {
      if (one.retain) {
        out.emplace(one.name, one);
      }
    }
  }
  return out;
}

// Describes what of a value is lost.
std::vector<std::string> losses(const schema::Variable& before, const schema::Variable& now) {
  const std::vector<std::uint8_t> old(before.type.size());
  std::vector<std::uint8_t> value(now.type.size());
  return schema::carry_value(now.name, {before.type, before.unit}, old, {now.type, now.unit}, value);
}

}  // namespace

std::vector<base::Diagnostic> retained_changes(const std::filesystem::path& glb, const std::string& now,
                                               const std::vector<std::string>& others) {
  std::vector<std::string> inputs = others;
  inputs.push_back(glb.string());
  const glb2idl::Compilation before = glb2idl::compile(inputs);
  const glb2idl::Compilation after = glb2idl::compile(inputs, [&](const std::string& path) {
    return path == glb.string() ? glb2idl::ReadResult{now, path, ""} : glb2idl::read_source_file(path);
  });
  std::vector<base::Diagnostic> out;
  const auto warn = [&](const std::string& text) {
    out.push_back({base::Diagnostic::Severity::Warning, glb.string(), {}, "retained " + text});
  };
  if (!before.ok || !after.ok) {
    return out;  // there was none, or it is not retained any more
  }
  const Retained kept = retained_of(after);
  for (const auto& [name, old] : retained_of(before)) {
    const auto found = kept.find(name);
    if (found == kept.end()) {
      warn(name + ": is no longer there; its node keeps the value in its files until a version has it again");
      continue;
    }
    const auto lost = losses(old, found->second);
    if (schema::canonical(old.type) != schema::canonical(found->second.type) || !lost.empty()) {
      warn(fmt::format("{}: was {}, is {}; a node keeps of its value what fits", name, schema::display_name(old.type),
                       schema::display_name(found->second.type)));
    }
    for (const std::string& one : lost) {
      warn(one);
    }
  }
  return out;
}

}  // namespace indurop::tools

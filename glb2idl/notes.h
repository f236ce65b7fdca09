// SPDX-License-Identifier: Apache-2.0
// Annotations: @unit("mm") @range(0, 180) @retain @view @optional @maxage(10ms) @fallback(0) @desc("...")
// @alarm("...", high).

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "glb2idl/context.h"

namespace indurop::glb2idl {

enum class NoteTarget { Variable, Field, Function, Other };

struct Notes {
  std::string unit;
  std::string description;
  std::optional<schema::Range> range;
  std::vector<schema::Alarm> alarms;
  bool retain = false;
  bool view = false;
  bool optional = false;
  std::int64_t maxage_ns = 0;
  const ast::Initializer* fallback = nullptr;  // inside the given annotation
};

// Evaluates the annotations before (`leading`) and after (`own`) a declarator of type `type`. `comment` is the
// description unless @desc overrides it. Wrong annotations are reported and left out.
[[nodiscard]] Notes read_notes(Context& context, const std::vector<ast::Annotation>& leading,
                               const std::vector<ast::Annotation>& own, const schema::Type& type, NoteTarget target,
                               std::string comment);

// Reads a time with its unit, such as 10ms; reports anything that is not a positive time.
[[nodiscard]] std::optional<std::int64_t> read_duration(Context& context, const ast::Expression& expression,
                                                        std::string_view what);

}  // namespace indurop::glb2idl

// SPDX-License-Identifier: Apache-2.0
#include "tools/values/force_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "rt/clock.h"
#include "tools/command/units.h"
#include "tools/values/variables.h"

namespace indurop::tools {

std::vector<ForceView> view_forces(const vars::Store& store) {
  std::vector<ForceView> views;
  std::map<std::string, std::vector<std::uint8_t>> texts;  // they are forced word by word
  const rt::MonoTime now = store.now();
  for (const vars::Force& force : store.forces()) {
    const schema::Part part = schema::part_at(store.schema().variables[force.variable->schema_index], force.offset);
    std::vector<std::uint8_t> bytes(force.bytes().begin(), force.bytes().end());
    if (part.type.base == schema::Base::Text) {
      std::vector<std::uint8_t>& text = texts[part.name];
      text.insert(text.end(), bytes.begin(), bytes.end());
      bytes = text;
      bytes.resize(part.type.size());
      std::erase_if(views, [&](const ForceView& one) { return one.name == part.name; });
    }
    views.push_back({part.name, schema::format_value(part.type, bytes), raw_value(part.type, bytes),
                     force.until == vars::kForever ? std::nullopt : std::optional((force.until - now).count())});
  }
  return views;
}

std::string force_line(const std::vector<ForceView>& forces) {
  constexpr std::size_t kShown = 3;
  std::string line;
  for (std::size_t i = 0; i < forces.size() && i < kShown; ++i) {
    const ForceView& one = forces[i];
    line += fmt::format("{}{} = {}", i == 0 ? "" : ", ", one.name, one.value);
    line += one.left_ns ? fmt::format(" ({} left)", human_age(*one.left_ns)) : "";
  }
  return forces.size() > kShown ? line + fmt::format(" and {} more", forces.size() - kShown) : line;
}

JsonValue json_of(const std::vector<ForceView>& forces) {
  JsonValue list = JsonValue::array();
  for (const ForceView& one : forces) {
    list.push_back(
        {{"name", one.name}, {"value", one.raw}, {"left_ns", one.left_ns ? JsonValue(*one.left_ns) : JsonValue()}});
  }
  return list;
}

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "tools/client/values/force_view.h"

#include <fmt/format.h>

#include "core/rt/clock.h"
#include "store/vars/held_value.h"
#include "tools/client/text/units.h"
#include "tools/client/values/variables.h"

namespace indurop::tools {

std::vector<ForceView> view_forces(const std::string& node, const vars::Store& store) {
  std::vector<ForceView> views;
  const auto custody = vars::Custody::open(node, vars::Mode::ReadOnly);
  const rt::MonoTime now = store.now();
  for (const vars::ForcedPart& part : vars::forced_parts(store)) {
    ForceView view{part.name,
                   schema::format_value(part.type, part.bytes),
                   raw_value(part.type, part.bytes),
                   part.until == vars::kForever ? std::nullopt : std::optional((part.until - now).count()),
                   {}};
    view.note = custody ? custody->note_of(*part.variable, part.offset).value_or(vars::ForceNote()) : vars::ForceNote();
    views.push_back(std::move(view));
  }
  return views;
}

std::string who_and_why(const vars::Note& note) {
  std::string text = note.who;
  text += note.from.empty() ? "" : fmt::format(" on {}", note.from);
  return text + (note.reason.empty() ? "" : fmt::format("{}{}", text.empty() ? "" : ": ", note.reason));
}

std::string force_line(const std::vector<ForceView>& forces) {
  constexpr std::size_t kShown = 3;
  std::string line;
  for (std::size_t i = 0; i < forces.size() && i < kShown; ++i) {
    const ForceView& one = forces[i];
    line += fmt::format("{}{} = {}", i == 0 ? "" : ", ", one.name, one.value);
    std::string about = one.note.lease ? "while its client is there"
                        : one.left_ns  ? human_age(*one.left_ns) + " left"
                                       : "";
    if (const std::string who = who_and_why(one.note); !who.empty()) {
      about += (about.empty() ? "" : ", ") + who;
    }
    line += about.empty() ? "" : fmt::format(" ({})", about);
  }
  return forces.size() > kShown ? line + fmt::format(" and {} more", forces.size() - kShown) : line;
}

JsonValue json_of(const std::vector<ForceView>& forces) {
  JsonValue list = JsonValue::array();
  for (const ForceView& one : forces) {
    list.push_back({{"name", one.name},
                    {"value", one.raw},
                    {"left_ns", one.left_ns ? JsonValue(*one.left_ns) : JsonValue()},
                    {"who", one.note.who},
                    {"from", one.note.from},
                    {"reason", one.note.reason},
                    {"lease", one.note.lease}});
  }
  return list;
}

JsonValue json_of(const vars::LockNote& note) {
  return {{"lock", vars::word_of(note.lock)},
          {"who", note.who},
          {"from", note.from},
          {"reason", note.reason},
          {"wall_ns", note.wall_ns}};
}

std::string lock_line(const vars::LockNote& note) {
  if (note.lock == vars::WriteLock::None) {
    return {};
  }
  const std::string who = who_and_why(note);
  return fmt::format("{}{}", vars::word_of(note.lock), who.empty() ? "" : fmt::format(" ({})", who));
}

}  // namespace indurop::tools

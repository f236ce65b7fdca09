// SPDX-License-Identifier: Apache-2.0
#include "history/alarms/declared_alarms.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/schema/leaf.h"

namespace indurop::alarms {
namespace {

bool has_alarms(const schema::Type& type) {
  return std::any_of(type.fields.begin(), type.fields.end(),
                     [](const schema::Field& field) { return !field.alarms.empty() || has_alarms(field.type); });
}

class Collector {
 public:
  Collector(const schema::Variable& variable, const vars::DirectoryEntry* entry, std::vector<DeclaredAlarm>& to)
      : variable_(variable), entry_(entry), to_(to) {}

  void walk(const schema::Type& type, std::size_t level, const std::string& name, std::uint32_t offset,
            const std::vector<schema::Alarm>& alarms, const std::string& unit) {
    if (to_.size() >= kMaxAlarms || (alarms.empty() && !has_alarms(type))) {
      return;
    }
    if (level < type.dims.size()) {
      const auto stride = static_cast<std::uint32_t>(schema::stride_of(type, level));
      for (std::uint32_t i = 0; i < type.dims[level] && to_.size() < kMaxAlarms; ++i) {
        walk(type, level + 1, fmt::format("{}[{}]", name, i), offset + i * stride, alarms, unit);
      }
      return;
    }
    for (const schema::Field& field : type.fields) {
      walk(field.type, 0, fmt::format("{}.{}", name, field.name), offset + field.offset, field.alarms, field.unit);
    }
    for (const schema::Alarm& alarm : alarms) {
      schema::Type single = type;
      single.dims.clear();
      const std::string condition = schema::condition_text(single, alarm);
      to_.push_back({condition.empty() ? name : fmt::format("{} {}", name, condition), name, unit, alarm,
                     std::move(single), offset, &variable_, entry_});
    }
  }

 private:
  const schema::Variable& variable_;
  const vars::DirectoryEntry* entry_;
  std::vector<DeclaredAlarm>& to_;
};

}  // namespace

std::vector<DeclaredAlarm> declared_alarms(const vars::Store& store) {
  std::vector<DeclaredAlarm> all;
  for (const schema::Variable& variable : store.schema().variables) {
    if (const auto* entry = store.find(variable.name_hash())) {
      Collector(variable, entry, all).walk(variable.type, 0, variable.name, 0, variable.alarms, variable.unit);
    }
  }
  return all;
}

}  // namespace indurop::alarms

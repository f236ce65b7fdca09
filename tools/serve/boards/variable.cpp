// SPDX-License-Identifier: Apache-2.0
#include "tools/serve/boards/variable.h"

#include <indurop/detail/freshness.h>

#include <array>
#include <cmath>

#include "tools/client/values/here_source.h"

namespace indurop::serve {
namespace {

std::int64_t confirmed_of(const vars::Store& store, const tools::Item& item) noexcept {
  void* const entry = store.entry(item.entry->name_hash, item.entry->type_hash);
  return entry != nullptr ? abi::confirmed_of(entry, item.entry->kind).load(std::memory_order_acquire) : 0;
}

const char* kind_of(schema::Base base) noexcept {
  switch (base) {
    case schema::Base::Bool:
      return "bool";
    case schema::Base::Char:
      return "char";
    case schema::Base::Int8:
      return "i8";
    case schema::Base::UInt8:
      return "u8";
    case schema::Base::Int16:
      return "i16";
    case schema::Base::UInt16:
      return "u16";
    case schema::Base::Int32:
      return "i32";
    case schema::Base::UInt32:
      return "u32";
    case schema::Base::Int64:
      return "i64";
    case schema::Base::UInt64:
      return "u64";
    case schema::Base::Float:
      return "f32";
    case schema::Base::Double:
      return "f64";
    case schema::Base::Text:
      return "text";
    case schema::Base::Enum:
      return "enum";
    case schema::Base::Struct:
      return "struct";
  }
  return "";
}

base::Json field_of(const schema::Field& field) {
  base::Json out = base::Json::object();
  out["name"] = field.name;
  out["offset"] = field.offset;
  out["type"] = form_of(field.type);
  if (!field.unit.empty()) {
    out["unit"] = field.unit;
  }
  if (!field.description.empty()) {
    out["description"] = field.description;
  }
  if (field.range) {
    out["range"] = range_of(field.range);
  }
  return out;
}

}  // namespace

const char* word_of(Quality quality) noexcept {
  constexpr std::array kWords{"good", "stale", "silent", "unread"};
  return kWords.at(static_cast<std::size_t>(quality));
}

Quality quality_of(const vars::Store& store, const tools::Item& item) noexcept {
  const std::int64_t confirmed = confirmed_of(store, item);
  if (confirmed == 0) {
    return Quality::Good;
  }
  if (confirmed < 0) {
    return Quality::Silent;
  }
  const auto now = [&store] { return store.now().time_since_epoch().count(); };
  return detail::is_valid(confirmed, item.place.variable->maxage_ns, now) ? Quality::Good : Quality::Stale;
}

std::optional<std::int64_t> age_of(const vars::Store& store, const tools::Item& item) noexcept {
  const std::int64_t confirmed = confirmed_of(store, item);
  if (confirmed == 0 || confirmed == abi::kNeverConfirmed) {
    return std::nullopt;
  }
  return store.now().time_since_epoch().count() - std::abs(confirmed);
}

base::Json range_of(const std::optional<schema::Range>& range) {
  if (!range) {
    return {};
  }
  const auto end = [](double value) { return std::isfinite(value) ? base::Json(value) : base::Json(); };
  return {{"min", end(range->min)}, {"max", end(range->max)}};
}

base::Json form_of(const schema::Type& type) {
  base::Json out = base::Json::object();
  out["kind"] = kind_of(type.base);
  if (!type.name.empty()) {
    out["name"] = type.name;
  }
  out["size"] = type.element_size;
  if (!type.dims.empty()) {
    base::Json dims = base::Json::array();
    for (const std::uint32_t dim : type.dims) {
      dims.push_back(dim);
    }
    out["dims"] = std::move(dims);
  }
  if (type.base == schema::Base::Struct) {
    base::Json fields = base::Json::array();
    for (const schema::Field& field : type.fields) {
      fields.push_back(field_of(field));
    }
    out["fields"] = std::move(fields);
  }
  if (type.base == schema::Base::Enum) {
    base::Json names = base::Json::object();
    for (const schema::Enumerator& one : type.enumerators) {
      names[one.name] = one.value;
    }
    out["enumerators"] = std::move(names);
  }
  return out;
}

std::vector<tools::Item> items_named(const vars::Store& store, const std::string& node,
                                     const std::vector<std::string>& names, std::vector<std::string>& problems) {
  tools::KeptMessages messages;
  tools::Access access;
  access.messages = &messages;
  access.values = std::make_shared<tools::HereSource>(node, vars::Mode::ReadOnly);
  std::vector<tools::Item> items;
  tools::select_items(access, store, names, items, tools::Values::NotNeeded);
  problems.insert(problems.end(), messages.texts.begin(), messages.texts.end());
  return items;
}

}  // namespace indurop::serve

// SPDX-License-Identifier: Apache-2.0
#include "store/operate/item.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace indurop::operate {
namespace {

using base::Problem;

// Full name of a part that was given without its leading namespaces.
std::string full_name(const std::string& text, const schema::Place& place) {
  const std::string& variable = place.variable->name;
  // The variable's last part ends where an index or a field begins.
  const auto last = variable.rfind("::");
  const std::string base = last == std::string::npos ? variable : variable.substr(last + 2);
  std::size_t at = text.find(base);
  while (at != std::string::npos) {
    const std::size_t end = at + base.size();
    const bool starts = at == 0 || text[at - 1] == ':' || text[at - 1] == '.';
    if (starts && (end == text.size() || text[end] == '[' || text[end] == '.')) {
      return variable + text.substr(end);
    }
    at = text.find(base, at + 1);
  }
  return variable;
}

void add(std::vector<Item>& items, Item item) {
  const bool known = std::any_of(items.begin(), items.end(), [&](const Item& one) {
    return one.entry == item.entry && one.place.offset == item.place.offset && one.name == item.name;
  });
  if (!known) {
    items.push_back(std::move(item));
  }
}

bool read_text(const Assignment& one, std::span<std::uint8_t> bytes, std::string& message) {
  const schema::Type& type = one.item.place.type;
  return (one.literal != nullptr && one.literal(type, one.text, bytes)) ||
         schema::parse_value(type, one.text, bytes, message).ok();
}

}  // namespace

Result<Item, Problem> find(const vars::Store& store, const std::string& name) {
  std::string message;
  const auto place = schema::find_place(store.schema(), name, message);
  const auto* entry = place ? store.find(place->variable->name_hash()) : nullptr;
  if (entry == nullptr) {
    return Problem{message.empty() ? fmt::format("there is no variable '{}'", name) : message};
  }
  return Item{full_name(name, *place), *place, entry};
}

Result<Item, Problem> whole(const vars::Store& store, const schema::Variable& variable) {
  const auto* entry = store.find(variable.name_hash());
  if (entry == nullptr) {
    return Problem{fmt::format("there is no variable '{}'", variable.name)};
  }
  return Item{variable.name, {&variable, variable.type, 0, variable.unit, variable.range}, entry};
}

Result<std::vector<Item>, std::vector<std::string>> select(const vars::Store& store,
                                                           const std::vector<std::string>& names) {
  std::vector<Item> items;
  std::vector<std::string> wrong;
  for (const std::string& name : names) {
    if (!schema::is_glob(name)) {
      auto found = find(store, name);
      if (found) {
        add(items, std::move(found).value());
      } else {
        wrong.push_back(found.error().text);
      }
      continue;
    }
    bool any = false;
    for (const schema::Variable& variable : store.schema().variables) {
      auto found = schema::glob_match(name, variable.name) ? whole(store, variable) : Problem{};
      if (found) {
        add(items, std::move(found).value());
        any = true;
      }
    }
    if (!any) {
      wrong.push_back(fmt::format("no variable matches '{}'", name));
    }
  }
  if (!wrong.empty()) {
    return wrong;
  }
  return items;
}

Result<std::vector<std::uint8_t>, Problem> read(const vars::Store& store, const Item& item) {
  std::vector<std::uint8_t> bytes(item.place.type.size());
  if (const Status status = store.read(*item.entry, item.place.offset, bytes); !status) {
    return Problem{
        fmt::format("{} cannot be read: {} ({})", item.name, status.error().where, to_string(status.error().code))};
  }
  return bytes;
}

Result<Assignment, Problem> parse(const vars::Store& store, Item item, std::string text, ReadLiteral literal) {
  const schema::Place place = item.place;
  Assignment one{std::move(item), std::vector<std::uint8_t>(place.type.size()), std::move(text), literal};
  // Parts of a value that are not mentioned keep their value.
  if (auto now = read(store, one.item)) {
    one.bytes = std::move(now).value();
  }
  std::string message;
  if (!read_text(one, one.bytes, message)) {
    return Problem{fmt::format(
        "{}: {}", one.item.name,
        message.empty() ? fmt::format("'{}' is not a valid {}", one.text, schema::display_name(place.type)) : message)};
  }
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const schema::Range range = place.range.value_or(schema::Range{-kUnlimited, kUnlimited});
  if (!schema::check_range(range, place.type, one.bytes, message)) {
    return Problem{fmt::format("{}: {}", one.item.name, message)};
  }
  return one;
}

Result<Assignment, Problem> parse(const vars::Store& store, const std::string& line, ReadLiteral literal) {
  const auto equals = line.find('=');
  if (equals == std::string::npos || equals == 0) {
    return Problem{fmt::format("'{}' is not an assignment; write NAME=VALUE", line)};
  }
  auto item = find(store, line.substr(0, equals));
  return item ? parse(store, std::move(item).value(), line.substr(equals + 1), literal) : std::move(item).error();
}

Result<std::vector<Assignment>, std::vector<std::string>> parse_all(const vars::Store& store,
                                                                    const std::vector<std::string>& lines,
                                                                    ReadLiteral literal) {
  std::vector<Assignment> all;
  std::vector<std::string> wrong;
  for (const std::string& line : lines) {
    auto one = parse(store, line, literal);
    if (one) {
      all.push_back(std::move(one).value());
    } else {
      wrong.push_back(one.error().text);
    }
  }
  if (!wrong.empty()) {
    return wrong;
  }
  return all;
}

void write_over(const Assignment& one, std::span<std::uint8_t> bytes) {
  std::string message;
  if (!read_text(one, bytes, message)) {
    std::copy(one.bytes.begin(), one.bytes.end(), bytes.begin());
  }
}

bool lies_in(const vars::Force& force, const Item& item) noexcept {
  const std::uint64_t begin = item.place.offset;
  return force.variable == item.entry && force.offset >= begin && force.offset < begin + item.place.type.size();
}

bool touches(const vars::Force& force, const Item& item) noexcept {
  const std::uint64_t begin = item.place.offset;
  return force.variable == item.entry && force.offset < begin + item.place.type.size() &&
         begin < force.offset + force.size;
}

}  // namespace indurop::operate

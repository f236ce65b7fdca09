// SPDX-License-Identifier: Apache-2.0
#include "store/operate/item.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "core/base/diagnostics.h"
#include "core/schema/given_bytes.h"
#include "core/schema/place_index.h"

namespace indurop::operate {
namespace {

using base::Problem;

// Keeps the errors of wrong names, no more than users read.
class Wrong {
 public:
  [[nodiscard]] bool any() const noexcept { return count_ > 0; }
  [[nodiscard]] bool full() const noexcept { return count_ >= kMostShown; }
  void add(std::string text) {
    if (++count_ <= kMostShown) {
      texts_.push_back(std::move(text));
    }
  }
  std::vector<std::string> take() {
    if (count_ > kMostShown) {
      texts_.push_back(fmt::format("too many errors, the first {} are shown", kMostShown));
    }
    return std::move(texts_);
  }

 private:
  static constexpr std::size_t kMostShown = base::Diagnostics::kMaxShown;
  std::size_t count_ = 0;
  std::vector<std::string> texts_;
};

Result<Item, Problem> item_of(const vars::Store& store, const std::string& name,
                              const Result<schema::Place, schema::Failure>& place) {
  if (!place) {
    return Problem{place.error().message};
  }
  const auto* entry = store.find(place->variable->name_hash());
  if (entry == nullptr) {
    return Problem{fmt::format("there is no variable '{}'", name)};
  }
  return Item{full_name(name, *place), *place, entry};
}

// As find(); the errors after those that are shown have no nearest name.
Result<Item, Problem> find(const vars::Store& store, const schema::PlaceIndex& index, const std::string& name,
                           const Wrong& wrong) {
  return item_of(store, name, index.find(name, wrong.full() ? schema::NearestName::Skip : schema::NearestName::Search));
}

// `find`: returns the item of a name.
template <class Find>
Result<Assignment, Problem> parse_line(const vars::Store& store, const std::string& line, ReadLiteral literal,
                                       const Find& find) {
  const auto equals = line.find('=');
  if (equals == std::string::npos || equals == 0) {
    return Problem{fmt::format("'{}' is not an assignment; write NAME=VALUE", line)};
  }
  Result<Item, Problem> item = find(line.substr(0, equals));
  return item ? parse(store, std::move(item).value(), line.substr(equals + 1), literal) : std::move(item).error();
}

Result<void, schema::Failure> read_text(const Assignment& one, std::span<std::uint8_t> bytes) {
  const schema::Type& type = one.item.place.type;
  if (one.literal != nullptr && one.literal(type, one.text, bytes)) {
    return {};
  }
  return schema::parse_value(type, one.text, bytes);
}

}  // namespace

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

Result<Item, Problem> find(const vars::Store& store, const std::string& name) {
  return item_of(store, name, schema::find_place(store.schema(), name));
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
  std::set<std::tuple<const vars::DirectoryEntry*, std::uint32_t, std::string>> known;
  const auto add = [&](Item item) {
    if (known.emplace(item.entry, item.place.offset, item.name).second) {
      items.push_back(std::move(item));
    }
  };
  const schema::PlaceIndex index(store.schema());
  Wrong wrong;
  for (const std::string& name : names) {
    if (!schema::is_glob(name)) {
      auto found = find(store, index, name, wrong);
      if (found) {
        add(std::move(found).value());
      } else {
        wrong.add(found.error().text);
      }
      continue;
    }
    bool any = false;
    for (const schema::Variable& variable : store.schema().variables) {
      auto found = schema::glob_match(name, variable.name) ? whole(store, variable) : Problem{};
      if (found) {
        add(std::move(found).value());
        any = true;
      }
    }
    if (!any) {
      wrong.add(fmt::format("no variable matches '{}'", name));
    }
  }
  if (wrong.any()) {
    return wrong.take();
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
  if (const auto read_in = read_text(one, one.bytes); !read_in) {
    return Problem{fmt::format("{}: {}", one.item.name, read_in.error().message)};
  }
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  const schema::Range range = place.range.value_or(schema::Range{-kUnlimited, kUnlimited});
  if (const auto inside = schema::check_range(range, place.type, one.bytes); !inside) {
    return Problem{fmt::format("{}: {}", one.item.name, inside.error().message)};
  }
  return one;
}

Result<Assignment, Problem> parse(const vars::Store& store, const std::string& line, ReadLiteral literal) {
  return parse_line(store, line, literal, [&](const std::string& name) { return find(store, name); });
}

Result<std::vector<Assignment>, std::vector<std::string>> parse_all(const vars::Store& store,
                                                                    const std::vector<std::string>& lines,
                                                                    ReadLiteral literal) {
  const schema::PlaceIndex index(store.schema());
  std::vector<Assignment> all;
  Wrong wrong;
  const auto found = [&](const std::string& name) { return find(store, index, name, wrong); };
  for (const std::string& line : lines) {
    if (auto one = parse_line(store, line, literal, found)) {
      all.push_back(std::move(one).value());
    } else {
      wrong.add(one.error().text);
    }
  }
  if (wrong.any()) {
    return wrong.take();
  }
  return all;
}

std::vector<std::uint8_t> given_bytes(const Assignment& one) {
  return schema::given_bytes(one.bytes.size(), [&](std::span<std::uint8_t> over) { return read_text(one, over).ok(); });
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

bool overlay(std::span<const vars::Force> forces, const Item& item, std::span<std::uint8_t> bytes) noexcept {
  const std::size_t item_begin = item.place.offset;
  bool any = false;
  for (const vars::Force& force : forces) {
    if (!touches(force, item)) {
      continue;
    }
    any = true;
    const std::size_t begin = std::max<std::size_t>(force.offset, item_begin);
    const std::size_t end = std::min<std::size_t>(force.offset + force.size, item_begin + bytes.size());
    for (std::size_t i = begin; i < end; ++i) {
      bytes[i - item_begin] = force.bytes()[i - force.offset];
    }
  }
  return any;
}

}  // namespace indurop::operate

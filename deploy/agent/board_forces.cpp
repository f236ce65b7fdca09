// SPDX-License-Identifier: Apache-2.0
#include "deploy/agent/board_forces.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "base/text.h"
#include "rt/clock.h"
#include "schema/schema.h"
#include "vars/store.h"

namespace indurop::deploy {
namespace {

using base::Problem;

struct Held {
  schema::Place place;
  const vars::DirectoryEntry* entry = nullptr;
  std::vector<std::uint8_t> bytes;
};

Result<vars::Store, Problem> open_store(const std::string& board) {
  auto store = vars::Store::attach(board, vars::Mode::ReadWrite);
  return store ? Result<vars::Store, Problem>(std::move(store).value())
               : Problem{fmt::format("its variables cannot be opened: {}", store.error().where)};
}

Result<Held, Problem> find(const vars::Store& store, const std::string& name) {
  std::string message;
  auto place = schema::find_place(store.schema(), name, message);
  if (!place) {
    return Problem{message.empty() ? fmt::format("there is no variable '{}'", name) : message};
  }
  const auto* entry = store.find(place->variable->name_hash());
  if (entry == nullptr) {
    return Problem{fmt::format("'{}' is not in use on this board", name)};
  }
  return Held{std::move(place).value(), entry, {}};
}

Result<Held, Problem> read(const vars::Store& store, const std::string& assignment) {
  const auto equals = assignment.find('=');
  const std::string name = assignment.substr(0, equals);
  if (equals == std::string::npos) {
    return Problem{fmt::format("'{}' is not an assignment, write NAME=VALUE", assignment)};
  }
  auto held = find(store, name);
  if (!held) {
    return held;
  }
  const schema::Type& type = held->place.type;
  if (!type.dims.empty() || type.base == schema::Base::Struct || type.base == schema::Base::Text) {
    return Problem{fmt::format("{} is a {}; force its numbers one by one", name, schema::display_name(type))};
  }
  held->bytes.resize(type.size());
  constexpr double kUnlimited = std::numeric_limits<double>::infinity();
  std::string message;
  if (!schema::parse_value(type, assignment.substr(equals + 1), held->bytes, message) ||
      !schema::check_range(held->place.range.value_or(schema::Range{-kUnlimited, kUnlimited}), type, held->bytes,
                           message)) {
    return Problem{fmt::format("{}: {}", name, message)};
  }
  return held;
}

}  // namespace

Result<void, Problem> force_values(const std::string& board, const std::string& target) {
  const auto lines = base::lines_of(target);
  std::int64_t for_ns = -1;
  if (!lines.empty()) {
    (void)std::from_chars(lines[0].data(), lines[0].data() + lines[0].size(), for_ns);
  }
  if (lines.size() < 2 || for_ns < 0) {
    return Problem{"the command cannot be understood"};
  }
  auto store = open_store(board);
  if (!store) {
    return std::move(store).error();
  }
  std::vector<Held> all;
  std::vector<std::string> wrong;
  for (auto line = lines.begin() + 1; line != lines.end(); ++line) {
    auto held = read(*store, *line);
    if (held) {
      all.push_back(std::move(held).value());
    } else {
      wrong.push_back(held.error().text);
    }
  }
  if (!wrong.empty()) {
    return Problem{fmt::format("{}", fmt::join(wrong, "; "))};
  }
  const rt::MonoTime until =
      for_ns > 0 ? store->now() + std::chrono::nanoseconds(for_ns) : rt::MonoTime(vars::kForever);
  for (const Held& one : all) {
    if (const Status forced = store->force(*one.entry, one.place.offset, one.bytes, until); !forced) {
      return Problem{forced.error().code == Errc::NoSpace
                         ? fmt::format("{} values are forced already, which is the most", vars::kMostForces)
                         : fmt::format("{} is not forced: {}", one.place.variable->name, forced.error().where)};
    }
  }
  return {};
}

Result<void, Problem> unforce_values(const std::string& board, const std::string& target) {
  auto store = open_store(board);
  if (!store) {
    return std::move(store).error();
  }
  std::vector<Held> named;
  for (const std::string& name : target == "*" ? std::vector<std::string>() : base::lines_of(target)) {
    auto found = find(*store, name);
    if (!found) {
      return found.error();
    }
    named.push_back(std::move(found).value());
  }
  for (const vars::Force& force : store->forces()) {
    const bool meant = target == "*" || std::any_of(named.begin(), named.end(), [&](const Held& one) {
                         return force.variable == one.entry && force.offset >= one.place.offset &&
                                force.offset < one.place.offset + one.place.type.size();
                       });
    if (const Status gone = meant ? store->let_go(*force.variable, force.offset) : Status();
        !gone && gone.error().code != Errc::NotFound) {
      return Problem{fmt::format("{} is still forced: {}", force.variable->name_hash, gone.error().where)};
    }
  }
  return {};
}

}  // namespace indurop::deploy

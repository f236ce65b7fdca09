// SPDX-License-Identifier: Apache-2.0
#include "store/vars/held_value.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>

#include "core/schema/given_bytes.h"

namespace indurop::vars {
namespace {

constexpr std::uint32_t kWord = 8;

// Calls `use(leaf, offset)` for every number, text or character of a value, up to its end.
template <class Use>
void for_each_leaf(const schema::Type& type, std::uint32_t offset, const Use& use) {
  std::uint64_t count = 1;
  for (const std::uint32_t dim : type.dims) {
    count *= dim;
  }
  schema::Type element = type;
  element.dims.clear();
  for (std::uint64_t i = 0; i < count; ++i, offset += type.element_size) {
    if (type.base != schema::Base::Struct) {
      use(element, offset);
      continue;
    }
    for (const schema::Field& field : type.fields) {
      for_each_leaf(field.type, offset + field.offset, use);
    }
  }
}

void add_text(std::span<const std::uint8_t> text, std::uint32_t offset, std::vector<HeldPart>& parts) {
  const auto end = std::find(text.begin(), text.end(), std::uint8_t{0});
  auto left = static_cast<std::uint32_t>(end - text.begin()) + (end == text.end() ? 0U : 1U);
  while (left > 0) {
    const std::uint32_t size = std::min(kWord, std::bit_floor(left));
    parts.push_back({offset, size});
    offset += size;
    left -= size;
  }
}

bool is_held_by(const Force& force, const HeldValue& value, const HeldPart& part) noexcept {
  return force.variable == value.variable && force.offset == value.offset + part.offset && force.size == part.size;
}

bool holds_same(const Force& force, const HeldValue& value, const HeldPart& part) {
  const auto bytes = std::span(value.bytes).subspan(part.offset, part.size);
  return is_held_by(force, value, part) && std::equal(bytes.begin(), bytes.end(), force.bytes().begin());
}

// Releases the forces of a longer earlier text after the end of the new one.
Status release_texts(Store& store, const HeldValue& value, const std::vector<Force>& before) {
  Status status;
  for_each_leaf(value.type, value.offset, [&](const schema::Type& leaf, std::uint32_t offset) {
    if (leaf.base != schema::Base::Text || std::none_of(value.parts.begin(), value.parts.end(), [&](const HeldPart& p) {
          return value.offset + p.offset == offset;
        })) {
      return;
    }
    for (const Force& force : before) {
      if (force.variable == value.variable && force.offset >= offset && force.offset < offset + leaf.text_size) {
        const Status gone = store.release(*force.variable, force.offset);
        status = gone.ok() || gone.error().code == Errc::NotFound ? status : gone;
      }
    }
  });
  return status;
}

// Calls `act(part)` where the force is still the one that ends at `was`.
template <class Act>
Status for_each_own(Store& store, std::span<const HeldValue> values, rt::MonoTime was, const Act& act) {
  const std::vector<Force> now = store.forces();
  Status status;
  for (const HeldValue& value : values) {
    for (const HeldPart& part : value.parts) {
      const bool own = std::any_of(now.begin(), now.end(), [&](const Force& force) {
        return force.until == was && holds_same(force, value, part);
      });
      const Status done = own ? act(value, part) : Status(Error{Errc::NotFound, 0, "forced part"});
      status = done.ok() ? status : done;
    }
  }
  return status;
}

}  // namespace

std::vector<HeldPart> parts_to_hold(const schema::Type& type, std::string_view text,
                                    std::span<const std::uint8_t> bytes) {
  const auto given = schema::given_bytes(
      type.size(), [&](std::span<std::uint8_t> over) { return schema::parse_value(type, text, over).ok(); });
  std::vector<HeldPart> parts;
  for_each_leaf(type, 0, [&](const schema::Type& leaf, std::uint32_t offset) {
    const auto size = static_cast<std::uint32_t>(leaf.size());
    if (std::count(given.begin() + offset, given.begin() + offset + size, 0) != 0) {
      return;
    }
    if (leaf.base == schema::Base::Text) {
      add_text(bytes.subspan(offset, size), offset, parts);
    } else {
      parts.push_back({offset, size});
    }
  });
  return parts;
}

Status hold(Store& store, std::span<const HeldValue> values, rt::MonoTime until) {
  const std::vector<Force> before = store.forces();
  std::size_t more = 0;
  for (const HeldValue& value : values) {
    more += static_cast<std::size_t>(std::count_if(value.parts.begin(), value.parts.end(), [&](const HeldPart& part) {
      return std::none_of(before.begin(), before.end(), [&](const Force& force) {
        return force.variable == value.variable && force.offset == value.offset + part.offset;
      });
    }));
  }
  if (before.size() + more > kMaxForces) {
    return Error{Errc::NoSpace, 0, "table of forces"};
  }
  for (const HeldValue& value : values) {
    Status status = release_texts(store, value, before);
    for (const HeldPart& part : value.parts) {
      if (!status) {
        break;
      }
      status = store.force(*value.variable, value.offset + part.offset,
                           std::span(value.bytes).subspan(part.offset, part.size), until);
    }
    if (!status) {
      (void)release(store, values, until);
      return status;
    }
  }
  return {};
}

Status prolong(Store& store, std::span<const HeldValue> values, rt::MonoTime was, rt::MonoTime until) {
  return for_each_own(store, values, was, [&](const HeldValue& value, const HeldPart& part) {
    return store.prolong(*value.variable, value.offset + part.offset, was, until);
  });
}

Status release(Store& store, std::span<const HeldValue> values, rt::MonoTime was) {
  return for_each_own(store, values, was, [&](const HeldValue& value, const HeldPart& part) {
    return store.release(*value.variable, value.offset + part.offset);
  });
}

std::vector<ForcedPart> forced_parts(const Store& store) {
  std::vector<ForcedPart> all;
  for (const Force& force : store.forces()) {
    const schema::Variable& variable = store.schema().variables[force.variable->schema_index];
    schema::Part part = schema::part_at(variable, force.offset);
    if (part.type.base != schema::Base::Text) {
      all.push_back({std::move(part.name),
                     std::move(part.type),
                     {force.bytes().begin(), force.bytes().end()},
                     force.until,
                     force.variable,
                     force.offset});
      continue;
    }
    auto text = std::find_if(all.begin(), all.end(), [&](const ForcedPart& one) {
      return one.variable == force.variable && one.name == part.name;
    });
    if (text == all.end()) {
      std::vector<std::uint8_t> bytes(part.type.size());
      all.push_back(
          {std::move(part.name), std::move(part.type), std::move(bytes), force.until, force.variable, force.offset});
      text = all.end() - 1;
    }
    const auto place = schema::find_place(store.schema(), text->name);
    const std::size_t at = place ? force.offset - place->offset : text->bytes.size();
    if (at + force.size <= text->bytes.size()) {
      std::copy(force.bytes().begin(), force.bytes().end(), text->bytes.begin() + static_cast<std::ptrdiff_t>(at));
    }
  }
  return all;
}

}  // namespace indurop::vars

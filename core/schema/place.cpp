// SPDX-License-Identifier: Apache-2.0
// Finds the part of a variable that a text like "knu.Robot.joints[1].y" refers to.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "core/base/nearest.h"
#include "core/base/text.h"
#include "core/schema/leaf.h"
#include "core/schema/place_index.h"

namespace indurop::schema {
namespace {

// One piece of the text: a name, or an index in brackets.
struct Step {
  std::string_view name;  // empty: an index
  std::uint64_t index = 0;
  std::string_view digits;    // the index as it is written
  bool after_colons = false;  // "::" precedes the name: it cannot be a field
};

struct Path {
  std::vector<Step> steps;
  std::size_t names = 0;  // steps before the first index
  bool absolute = false;  // begins with "::"
};

bool letter_or_digit(char c) noexcept {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool consume(std::string_view& text, std::string_view token) noexcept {
  const bool there = text.substr(0, token.size()) == token;
  text.remove_prefix(there ? token.size() : 0);
  return there;
}

Failure syntax(std::string_view whole, const std::string& what) {
  return {Errc::InvalidArgument, fmt::format("'{}': {}; write a name like joints[1].y", whole, what)};
}

// Splits the text. An empty code means success.
Failure split(std::string_view whole, Path& path) {
  std::string_view rest = whole;
  path.absolute = consume(rest, "::");
  bool after_colons = false;
  for (bool name_next = true;;) {
    if (name_next) {
      std::size_t length = 0;
      while (length < rest.size() && letter_or_digit(rest[length])) {
        ++length;
      }
      if (length == 0) {
        return syntax(whole,
                      rest.empty() ? "the end is missing" : fmt::format("no name begins with '{}'", rest.front()));
      }
      path.steps.push_back({rest.substr(0, length), 0, {}, after_colons});
      rest.remove_prefix(length);
    } else {
      std::uint64_t index = 0;
      const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), index);
      const std::string_view digits = rest.substr(0, static_cast<std::size_t>(end - rest.data()));
      rest.remove_prefix(digits.size());
      if (error == std::errc::invalid_argument || !consume(rest, "]")) {
        return syntax(whole, "an index is a whole number in brackets");
      }
      path.steps.push_back({{}, error == std::errc() ? index : UINT64_MAX, digits, false});
    }
    if (rest.empty()) {
      break;
    }
    after_colons = consume(rest, "::");
    name_next = after_colons || consume(rest, ".");
    if (!name_next && !consume(rest, "[")) {
      return syntax(whole, fmt::format("'{}' does not belong here", rest.front()));
    }
  }
  path.names = static_cast<std::size_t>(
      std::find_if(path.steps.begin(), path.steps.end(), [](const Step& s) { return s.name.empty(); }) -
      path.steps.begin());
  return {};
}

std::string join(const std::vector<Step>& steps, std::size_t count) {
  std::string out;
  for (std::size_t i = 0; i < count; ++i) {
    out += i == 0 ? "" : "::";
    out += steps[i].name;
  }
  return out;
}

// Returns the text up to step `count` for messages: "joints", "joints[1].pose".
std::string shown(const Variable& variable, const std::vector<Step>& steps, std::size_t first, std::size_t count) {
  std::string out = variable.name;
  for (std::size_t i = first; i < count; ++i) {
    out += steps[i].name.empty() ? fmt::format("[{}]", steps[i].digits) : fmt::format(".{}", steps[i].name);
  }
  return out;
}

std::string element_name(const Type& type) {
  Type element = type;
  element.dims.clear();
  return display_name(element);
}

// Follows steps from `first` on through the type of `variable`.
class Walk {
 public:
  Walk(const Variable& variable, const std::vector<Step>& steps, std::size_t first)
      : steps_(steps), first_(first), type_(&variable.type) {
    place_.variable = &variable;
    place_.unit = variable.unit;
    place_.range = variable.range;
  }

  Failure run(Place& to) {
    for (std::size_t i = first_; i < steps_.size(); ++i) {
      Failure failure = steps_[i].name.empty() ? index(i) : field(i);
      if (failure.code != Errc::Ok) {
        return failure;
      }
    }
    to = std::move(place_);
    if (in_text_) {
      to.type.base = Base::Char;
      to.type.element_size = 1;
      return {};
    }
    to.type = *type_;
    to.type.dims.erase(to.type.dims.begin(), to.type.dims.begin() + static_cast<std::ptrdiff_t>(dim_));
    return {};
  }

 private:
  [[nodiscard]] std::string here(std::size_t step) const { return shown(*place_.variable, steps_, first_, step); }

  Failure index(std::size_t step) {
    const bool of_text = dim_ == type_->dims.size() && type_->base == Base::Text && !in_text_;
    if (dim_ == type_->dims.size() && !of_text) {
      return {Errc::InvalidArgument, fmt::format("{} is a {}, not an array; leave out the [{}]", here(step),
                                                 in_text_ ? "char" : element_name(*type_), steps_[step].digits)};
    }
    const std::uint32_t bound = of_text ? type_->text_size : type_->dims[dim_];
    if (steps_[step].index >= bound) {
      return {Errc::OutOfRange, fmt::format("index {} is outside {}, which has {} element{}: 0 to {}",
                                            steps_[step].digits, here(step), bound, bound == 1 ? "" : "s", bound - 1)};
    }
    const std::uint64_t stride = of_text ? 1 : stride_of(*type_, dim_);
    place_.offset += static_cast<std::uint32_t>(steps_[step].index * stride);
    in_text_ = of_text;
    dim_ += of_text ? 0 : 1;
    return {};
  }

  Failure field(std::size_t step) {
    const std::string_view name = steps_[step].name;
    if (steps_[step].after_colons) {
      return {Errc::InvalidArgument, fmt::format("{} is a variable; its fields follow a '.', not '::'", here(step))};
    }
    if (dim_ < type_->dims.size() && type_->base == Base::Struct) {
      return {Errc::InvalidArgument, fmt::format("{} is an array of {}; name one element: {}[0].{}", here(step),
                                                 type_->dims[dim_], here(step), name)};
    }
    if (type_->base != Base::Struct) {
      return {Errc::NotFound, fmt::format("{} is a {} and has no field '{}'", here(step),
                                          in_text_ ? "char" : display_name(*type_), name)};
    }
    const auto found = std::find_if(type_->fields.begin(), type_->fields.end(),
                                    [name](const Field& candidate) { return candidate.name == name; });
    if (found == type_->fields.end()) {
      return no_field(step);
    }
    place_.offset += found->offset;
    place_.unit = found->unit.empty() ? place_.unit : found->unit;
    place_.range = found->range ? found->range : place_.range;
    type_ = &found->type;
    dim_ = 0;
    return {};
  }

  [[nodiscard]] Failure no_field(std::size_t step) const {
    std::vector<std::string> names;
    for (const Field& candidate : type_->fields) {
      names.push_back(candidate.name);
    }
    const std::string near = base::nearest(steps_[step].name, names);
    constexpr std::size_t kShown = 12;
    const bool more = names.size() > kShown;
    names.resize(std::min(names.size(), kShown));
    const std::string help = near.empty() ? fmt::format("it has {}{}", fmt::join(names, ", "), more ? ", ..." : "")
                                          : fmt::format("did you mean '{}'?", near);
    return {Errc::NotFound, fmt::format("{} has no field '{}'; {}", here(step), steps_[step].name, help)};
  }

  const std::vector<Step>& steps_;
  std::size_t first_;
  const Type* type_;
  std::size_t dim_ = 0;   // dims of *type_ already indexed
  bool in_text_ = false;  // the place is one char of a text
  Place place_;
};

// Returns true if `full` ends with `name`, starting at a namespace boundary.
bool ends_full_name(std::string_view full, std::string_view name) noexcept {
  if (full.size() <= name.size() + 2) {
    return false;
  }
  const std::size_t border = full.size() - name.size();
  return full.substr(border) == name && full.substr(border - 2, 2) == "::";
}

// Returns the last `count` parts of a full name; empty if it has fewer.
std::string last_parts(std::string_view full, std::size_t count) {
  std::size_t at = full.size() + 2;
  for (std::size_t i = 0; i < count; ++i) {
    if (at < 3) {
      return {};
    }
    const std::size_t border = full.rfind("::", at - 3);
    at = border == std::string_view::npos ? 0 : border + 2;
  }
  return std::string(full.substr(at));
}

Failure no_variable(const Schema& schema, const Path& path) {
  const std::string typed = join(path.steps, path.names);
  const auto like = [&schema](std::string_view name, std::size_t parts) -> std::string {
    std::vector<std::string> ends;
    for (const Variable& variable : schema.variables) {
      ends.push_back(last_parts(variable.name, parts));
    }
    const std::string near = base::closest_name(name, ends);
    const auto at = static_cast<std::size_t>(std::find(ends.begin(), ends.end(), near) - ends.begin());
    return near.empty() ? near : schema.variables[at].name;
  };
  std::string near;
  for (std::size_t parts = path.names; parts > 0 && near.empty(); --parts) {
    near = like(join(path.steps, parts), parts);
  }
  if (near.empty()) {
    near = like(path.steps[path.names - 1].name, 1);
  }
  return {Errc::NotFound, near.empty() ? fmt::format("no variable '{}'; 'indurop vars' lists them", typed)
                                       : fmt::format("no variable '{}'; did you mean '{}'?", typed, near)};
}

constexpr std::size_t kShownOfAmbiguous = 4;

Failure ambiguous(std::string_view text, const std::vector<Place>& places) {
  std::string names;
  for (std::size_t i = 0; i < std::min(places.size(), kShownOfAmbiguous); ++i) {
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", places[i].variable->name);
  }
  return {Errc::NotFound, fmt::format("'{}' may be {}{}; write the namespace too", text, names,
                                      places.size() > kShownOfAmbiguous ? ", ..." : "")};
}

// Tries each way to split the names into variable and fields. `exact`: full names only. Adds matches to `places`, no
// more than a message needs; otherwise keeps the first failure of a variable whose name matches.
template <class Candidates>
void collect(const Candidates& candidates, const Path& path, bool exact, std::vector<Place>& places, Failure& failure) {
  for (std::size_t names = path.names; names > 0; --names) {
    const std::string wanted = join(path.steps, names);
    for (const Variable* variable : candidates(wanted)) {
      if (exact ? variable->name != wanted : !ends_full_name(variable->name, wanted)) {
        continue;
      }
      Place place;
      Failure why = Walk(*variable, path.steps, names).run(place);
      if (why.code == Errc::Ok) {
        places.push_back(std::move(place));
      } else if (failure.code == Errc::Ok) {
        failure = std::move(why);
      }
      if (places.size() > kShownOfAmbiguous) {
        return;
      }
    }
  }
}

// `candidates`: returns all variables that a name may refer to.
template <class Candidates>
Result<Place, Failure> find(const Schema& schema, const Candidates& candidates, std::string_view text,
                            NearestName nearest) {
  const std::string_view name = base::trimmed(text);
  Path path;
  Failure failure = split(name, path);
  if (failure.code == Errc::Ok) {
    std::vector<Place> places;
    collect(candidates, path, true, places, failure);
    if (places.empty() && !path.absolute) {
      collect(candidates, path, false, places, failure);
    }
    if (places.size() == 1) {
      return std::move(places.front());
    }
    if (!places.empty()) {
      failure = ambiguous(name, places);
    } else if (failure.code == Errc::Ok) {
      failure = nearest == NearestName::Skip ? Failure{Errc::NotFound, fmt::format("no variable '{}'", name)}
                                             : no_variable(schema, path);
    }
  }
  return failure;
}

}  // namespace

Result<Place, Failure> find_place(const Schema& schema, std::string_view text) {
  std::vector<const Variable*> all;
  for (const Variable& variable : schema.variables) {
    all.push_back(&variable);
  }
  return find(
      schema, [&all](std::string_view) -> const auto& { return all; }, text, NearestName::Search);
}

PlaceIndex::PlaceIndex(const Schema& schema) : schema_(schema) {
  for (const Variable& variable : schema.variables) {
    std::string_view ending = variable.name;
    by_ending_[ending].push_back(&variable);
    for (std::size_t at = ending.find("::"); at != std::string_view::npos; at = ending.find("::")) {
      ending.remove_prefix(at + 2);
      by_ending_[ending].push_back(&variable);
    }
  }
}

Result<Place, Failure> PlaceIndex::find(std::string_view text, NearestName nearest) const {
  static const std::vector<const Variable*> kNone;
  const auto candidates = [this](const std::string& wanted) -> const auto& {
    const auto found = by_ending_.find(wanted);
    return found == by_ending_.end() ? kNone : found->second;
  };
  return schema::find(schema_, candidates, text, nearest);
}

Part part_at(const Variable& variable, std::uint32_t offset) {
  Part part{variable.name, variable.type};
  for (;;) {
    std::uint64_t stride = part.type.size();
    for (const std::uint32_t dim : part.type.dims) {
      stride /= dim;
      part.name += fmt::format("[{}]", offset / stride);
      offset = static_cast<std::uint32_t>(offset % stride);
    }
    part.type.dims.clear();
    const auto field = std::find_if(part.type.fields.begin(), part.type.fields.end(), [offset](const Field& f) {
      return offset >= f.offset && offset - f.offset < f.type.size();
    });
    if (part.type.base != Base::Struct || field == part.type.fields.end()) {
      return part;
    }
    part.name += "." + field->name;
    offset -= field->offset;
    part.type = Type(field->type);
  }
}

const Variable* find_variable(const Schema& schema, std::string_view name) noexcept {
  const auto found = std::find_if(schema.variables.begin(), schema.variables.end(),
                                  [name](const Variable& v) { return v.name == name; });
  return found == schema.variables.end() ? nullptr : &*found;
}

}  // namespace indurop::schema

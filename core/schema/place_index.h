// SPDX-License-Identifier: Apache-2.0
// Finds variables by name where there are many names: find_place() compares each with all variables of the schema.

#pragma once

#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "core/schema/schema.h"

namespace indurop::schema {

// Whether the message of an unknown name has the nearest one, which takes time in proportion to the number of names.
enum class NearestName { Search, Skip };

class PlaceIndex {
 public:
  // Borrows the schema, which must not change.
  explicit PlaceIndex(const Schema& schema);

  // As find_place().
  [[nodiscard]] Result<Place, Failure> find(std::string_view text, NearestName nearest) const;

 private:
  const Schema& schema_;
  std::unordered_map<std::string_view, std::vector<const Variable*>> by_ending_;  // full names and parts after a "::"
};

}  // namespace indurop::schema

// SPDX-License-Identifier: Apache-2.0
// What the model descriptions of FMI 2 and FMI 3 have in common.

#pragma once

#include <map>
#include <string>
#include <string_view>

#include "doors/fmi/description/description.h"

namespace indurop::fmi {

// Returns ` name="text"`, with what XML needs instead of its own characters; characters that XML does not have become
// '?'.
std::string attribute(std::string_view name, std::string_view text);
// The same, but nothing for an empty text.
std::string attribute_if(std::string_view name, std::string_view text);

// Returns the initial value of a part: a number, true or false, a text.
std::string start_of(const ChosenVariable& variable);
// Returns the attributes min and max, as far as the range limits the type and includes the initial value.
std::string limits_of(const ChosenVariable& variable);

// Returns <UnitDefinitions> with the units of numbers for which `has_unit` is true; empty if there are none.
std::string unit_definitions(const Description& description, bool (*has_unit)(schema::Base base));
// Returns the enumerations that the variables have, by name.
std::map<std::string, const schema::Type*> enumerations_of(const Description& description);
// Returns the elements <Item> of an enumeration: the first name of each number.
std::string items_of(const schema::Type& enumeration);
std::string log_categories();
std::string default_experiment(const Description& description);

}  // namespace indurop::fmi

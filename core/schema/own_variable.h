// SPDX-License-Identifier: Apache-2.0
// Tells the variables that the author of a module wrote from those of compilers, of libraries that consist of headers
// and of the platform, by their symbols.

#pragma once

#include <optional>
#include <string>

namespace indurop::schema {

// Returns the name of a variable as its author wrote it: "Filter::last" for _ZN6Filter4lastE, "count" for a static
// variable of a function. Returns nothing if the symbol is not one of the author.
std::optional<std::string> own_variable(const std::string& symbol);

}  // namespace indurop::schema

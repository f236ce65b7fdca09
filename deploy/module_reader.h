// SPDX-License-Identifier: Apache-2.0
// What the elements below one <module> mean.

#pragma once

#include "deploy/element.h"
#include "deploy/report.h"

namespace indurop::deploy {

// Checks shared by root and module elements.
bool is_leaf(const Element& element, Report& report);
void check_attributes(const Element& element, const std::vector<std::string>& known, Report& report);
void check_no_text(const Element& container, Report& report);
int read_core(const Element& element, Report& report);

// A module as far as it can be read; `folder` is where relative file names start. Its name is still empty if it has
// no <name>.
Module read_module(const Element& element, const std::filesystem::path& folder, Report& report);

}  // namespace indurop::deploy

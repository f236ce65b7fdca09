// SPDX-License-Identifier: Apache-2.0
// Describes errors of a command line in our own words instead of CLI11's.

#pragma once

#include <string>

#include "core/base/options.h"

namespace CLI {
class ParseError;
}  // namespace CLI

namespace indurop::base {

// CLI11 is given "_file" for an argument "file": from 2.4 on it takes "file" and "--file" of one verb for the same.
constexpr char kArgumentMark = '_';

// Call after `app` has failed to parse the options that `command` describes.
std::string wrong_words(const CLI::ParseError& error, const CLI::App& app, const CommandText& command);

}  // namespace indurop::base

// SPDX-License-Identifier: Apache-2.0
// Facts in a file beside the runs of a recording, whose runs and values they do not repeat. What is not there, or makes
// no sense, stays as it was: the file may be of another release.

#pragma once

#include <string>
#include <string_view>

#include "base/json.h"
#include "explain/answer.h"
#include "explain/facts.h"

namespace indurop::explain {

// Name of the attachment.
inline constexpr std::string_view kFactsFile = "indurop.facts.json";

std::string facts_text(const Facts& facts);
// False if it is no such text.
bool read_facts(std::string_view text, Facts& facts);

base::Json json_of(const Answer& answer);

}  // namespace indurop::explain

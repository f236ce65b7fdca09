// SPDX-License-Identifier: Apache-2.0
// The facts as a file attached to a recording, without the runs and values that the recording already has. Missing or
// invalid fields keep their values: the file may be of another release.

#pragma once

#include <string>
#include <string_view>

#include "core/base/json.h"
#include "history/explain/answer.h"
#include "history/explain/facts.h"

namespace indurop::explain {

// The name of the attachment.
inline constexpr std::string_view kFactsFile = "indurop.facts.json";

std::string facts_text(const Facts& facts);
// Returns false if it is no such text.
bool read_facts(std::string_view text, Facts& facts);

base::Json json_of(const Answer& answer);

}  // namespace indurop::explain

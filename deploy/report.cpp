// SPDX-License-Identifier: Apache-2.0
#include "deploy/report.h"

namespace indurop::deploy {

void Report::add(Diagnostic::Severity severity, Place place, std::string text) {
  std::size_t& count = count_.at(static_cast<std::size_t>(severity));
  if (++count <= kMost) {
    out_.push_back({severity, file_, place, std::move(text)});
  } else if (count == kMost + 1) {
    out_.push_back({severity,
                    file_,
                    {},
                    "there are more than these " + std::to_string(kMost) + "; the others show when these are gone"});
  }
}

}  // namespace indurop::deploy

// SPDX-License-Identifier: Apache-2.0
#include "core/base/diagnostics.h"

#include <utility>

namespace indurop::base {

void Diagnostics::add(Diagnostic::Severity severity, SourcePlace place, std::string text) {
  add({severity, file_, place, std::move(text)});
}

void Diagnostics::add(Diagnostic one) {
  std::tuple key(one.file, one.place.line, one.place.column, one.text);
  if (known_.contains(key)) {
    return;
  }
  if (++count_.at(static_cast<std::size_t>(one.severity)) <= most_) {
    known_.insert(std::move(key));
    out_.push_back(std::move(one));
  }
}

void Diagnostics::add_summary(std::vector<Diagnostic>& to) const {
  const std::array names{"errors", "warnings", "notes"};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (count_.at(i) > most_) {
      to.push_back({static_cast<Diagnostic::Severity>(i),
                    file_,
                    {},
                    std::string("too many ") + names.at(i) + ", the first " + std::to_string(most_) + " are shown"});
    }
  }
}

}  // namespace indurop::base

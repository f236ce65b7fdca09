// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/diagnostics.h"

#include <fmt/format.h>

#include <utility>

#include "core/base/source_line.h"

namespace indurop::glb2idl {

void Diagnostics::error(Span at, std::string text) {
  if (all_.full()) {
    all_.error({}, std::move(text));  // only counted: no line is computed for an error that is not shown
    return;
  }
  const base::SourcePlace place = sources_.place_of(at);
  base::Diagnostic one{base::Diagnostic::Severity::Error, sources_.file(at.file).path, place, std::move(text)};
  one.picture =
      base::picture_of_line(sources_.line_text(at.file, place.line), static_cast<std::size_t>(place.column), at.length);
  all_.add(std::move(one));
}

std::string Diagnostics::place(Span at) const {
  return fmt::format("{}:{}", sources_.file(at.file).path, sources_.line_of(at));
}

void Diagnostics::finish() {
  std::vector<std::string> files{""};
  for (std::uint32_t i = 0; i < sources_.size(); ++i) {
    files.push_back(sources_.file(i).path);
  }
  base::sort_by_file(out_, files);
  all_.add_summary(out_);
}

}  // namespace indurop::glb2idl

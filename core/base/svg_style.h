// SPDX-License-Identifier: Apache-2.0
// Shared by the pictures of measurements: a style sheet that sets the appearance of elements by class.

#pragma once

#include <string>
#include <string_view>

#include "core/base/svg.h"

namespace indurop::base {

// class="kind"
std::string svg_class(std::string_view kind);
// `anchor` start|middle|end; `kind` is the class.
void svg_text(SvgPart& out, double x, double y, const char* anchor, const char* kind, std::string_view content);
void svg_line(SvgPart& out, double x1, double y1, double x2, double y2, const char* kind);
// Styles of head, label, grid and axis; pictures add their own.
inline constexpr const char* kSvgStyle =
    "text{fill:#22303c}.head{font-size:19px;font-weight:bold}.label{font-size:11px;fill:#55636f}.grid{stroke:#e4e9ed}"
    ".axis{stroke:#22303c;stroke-width:1.2}";

}  // namespace indurop::base

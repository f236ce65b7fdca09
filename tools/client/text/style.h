// SPDX-License-Identifier: Apache-2.0
// How a piece of text is to be emphasized where colours are shown.

#pragma once

namespace indurop::tools {

enum class Style { None, Bold, Dim, Good, Warn, Bad, Accent };

}  // namespace indurop::tools

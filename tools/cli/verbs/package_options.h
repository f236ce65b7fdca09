// SPDX-License-Identifier: Apache-2.0
// Options of the verbs that pack a plant's files: deploy and pack.

#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "core/base/options.h"
#include "core/base/text.h"
#include "tools/client/text/units.h"

namespace indurop::tools {

inline void add_comment_option(base::Options& line, std::string& comment) {
  static constexpr std::size_t kMaxCharacters = 200;
  line.add("-m,--comment", "TEXT", comment, "Description of this deployment, shown by history and boards")
      .check([](const std::string& text) {
        return base::characters(text) <= kMaxCharacters && printable(text) == text
                   ? std::string()
                   : fmt::format("a comment is one line of at most {} characters", kMaxCharacters);
      });
}

inline void add_also_option(base::Options& line, std::vector<std::string>& folders) {
  line.add("--also", "FOLDER", folders,
           "Also allow files of the plant from this folder, not only from the manifest's; may be repeated")
      .completes(base::Completion::Folder);
}

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "core/base/inside_folder.h"
#include "core/base/read_file.h"

namespace indurop::tools {

bool read_plc_file(Context& context, const std::string& file, std::string& bytes) {
  auto content = base::read_file(file);
  if (!content) {
    context.out.error(content.error().kind == base::FileProblem::Kind::NotRegular ||
                              content.error().kind == base::FileProblem::Kind::Directory
                          ? fmt::format("{}: this is not an ordinary file; give the path of the PLC program", file)
                          : base::cannot_read(file, content.error()));
    return false;
  }
  bytes = std::move(*content);
  return true;
}

std::optional<std::vector<std::string>> with_project_files(Context& context, const std::vector<std::string>& files) {
  namespace fs = std::filesystem;
  constexpr std::array<std::string_view, 5> kEndings{".dt", ".st", ".il", ".ld", ".fbd"};
  std::vector<std::string> out;
  bool fine = true;
  for (const std::string& one : files) {
    out.push_back(one);
    if (fs::path(one).filename() != "project.json") {
      continue;
    }
    std::vector<std::string> found;
    for (const char* folder : {"datatypes", "pous"}) {
      std::error_code error;
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(one).parent_path() / folder, error)) {
        if (std::find(kEndings.begin(), kEndings.end(), entry.path().extension()) != kEndings.end()) {
          found.push_back(entry.path().string());
        }
      }
    }
    std::sort(found.begin(), found.end());
    for (const std::string& file : found) {
      if (!base::lies_inside(file, fs::path(one).parent_path())) {
        context.out.error(
            fmt::format("{}: this link leads out of the folder of {}; put the file itself there", file, one));
        fine = false;
      }
    }
    std::copy_if(found.begin(), found.end(), std::back_inserter(out),
                 [&](const std::string& file) { return std::find(files.begin(), files.end(), file) == files.end(); });
  }
  return fine ? std::optional(std::move(out)) : std::nullopt;
}

void print_diagnostics(Context& context, const std::vector<base::Diagnostic>& diagnostics) {
  std::string text = base::to_text(diagnostics, "indurop plc");
  if (!text.empty()) {
    text.pop_back();  // message_line() ends the last line
    context.out.message_line(text);
  }
}

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "node/plant_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

#include "base/diagnostics.h"
#include "base/duration.h"
#include "base/read_file.h"
#include "base/text.h"

namespace indurop::node {
namespace {

using What = PlantEvent::What;

constexpr std::size_t kMostBytes = std::size_t{1} << 20U;
constexpr std::array<std::pair<const char*, What>, 3> kWords{
    {{"kill", What::Kill}, {"cut", What::Cut}, {"return", What::Return}}};

class ScriptReader {
 public:
  ScriptReader(const std::string& file, const std::vector<std::string>& boards, PlantScript& script)
      : boards_(boards), script_(script), report_(file, script.diagnostics) {}

  void read(std::string_view text) {
    for (int line = 1; !text.empty(); ++line) {
      const std::string_view one = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(one.size() + 1, text.size()));
      read_line(one.substr(0, one.find('#')), {line, 1});
    }
    std::stable_sort(script_.events.begin(), script_.events.end(),
                     [](const PlantEvent& a, const PlantEvent& b) { return a.at < b.at; });
    report_.add_summary(script_.diagnostics);
  }

 private:
  void read_line(std::string_view line, base::SourcePlace place) {
    std::istringstream words{std::string(line)};
    std::string time;
    std::string what;
    std::string board;
    std::string more;
    words >> time >> what >> board >> more;
    if (time.empty()) {
      return;
    }
    if (board.empty() || !more.empty()) {
      report_.error(place,
                    "this is no line of a script; write a time, then kill, cut or return, then a board: "
                    "500ms kill sensor");
      return;
    }
    const base::DurationText at = base::read_duration(time, true);
    if (!at.value) {
      report_.error(place, at.problem);
    }
    const auto* const word =
        std::find_if(kWords.begin(), kWords.end(), [&](const auto& known) { return what == known.first; });
    if (word == kWords.end()) {
      report_.error(place,
                    base::in_quotes(what) + " befalls no board" + base::suggestion(what, {"kill", "cut", "return"}));
    }
    const auto found = std::find(boards_.begin(), boards_.end(), board);
    if (found == boards_.end()) {
      report_.error(place, "the plant has no board " + base::in_quotes(board) + base::suggestion(board, boards_));
    }
    if (at.value && word != kWords.end() && found != boards_.end()) {
      script_.events.push_back({*at.value, word->second, static_cast<std::size_t>(found - boards_.begin()),
                                fmt::format("{} {}", what, board)});
    }
  }

  const std::vector<std::string>& boards_;
  PlantScript& script_;
  base::Diagnostics report_;
};

}  // namespace

PlantScript read_script_text(std::string_view text, const std::string& file, const std::vector<std::string>& boards) {
  PlantScript script;
  ScriptReader(file, boards, script).read(text);
  return script;
}

PlantScript read_script(const std::filesystem::path& file, const std::vector<std::string>& boards) {
  const auto text = base::read_file(file, kMostBytes);
  if (text) {
    return read_script_text(*text, file.string(), boards);
  }
  PlantScript script;
  script.diagnostics.push_back(
      {base::Diagnostic::Severity::Error, file.string(), {}, "cannot be read: " + text.error().text});
  return script;
}

}  // namespace indurop::node

// SPDX-License-Identifier: Apache-2.0
#include "node/simulate/plant_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <sstream>
#include <utility>

#include "core/base/diagnostics.h"
#include "core/base/duration.h"
#include "core/base/read_file.h"
#include "core/base/text.h"

namespace indurop::node {
namespace {

using What = PlantEvent::What;

constexpr std::size_t kMaxBytes = std::size_t{1} << 20U;
constexpr std::array<std::pair<const char*, What>, 3> kWords{
    {{"kill", What::Kill}, {"cut", What::Cut}, {"return", What::Return}}};

class ScriptReader {
 public:
  ScriptReader(const std::string& file, const std::vector<std::string>& boards,
               std::optional<std::chrono::nanoseconds> end, PlantScript& script)
      : boards_(boards), end_(end), script_(script), report_(file, script.diagnostics) {}

  void read(std::string_view text) {
    for (int line = 1; !text.empty(); ++line) {
      const std::string_view one = text.substr(0, text.find('\n'));
      text.remove_prefix(std::min(one.size() + 1, text.size()));
      read_line(one.substr(0, one.find('#')), {line, 1});
    }
    std::stable_sort(script_.events.begin(), script_.events.end(),
                     [](const PlantEvent& a, const PlantEvent& b) { return a.at < b.at; });
    check_end();
    check_effects();
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
                    "this is not a line of a script; write a time, then kill, cut or return, then a board: "
                    "500ms kill sensor");
      return;
    }
    base::DurationText at = base::read_duration(time, true);
    if (!at.value) {
      report_.error(place, at.problem);
    } else if (at.value->count() != 0 && time.find_first_not_of("0123456789") == std::string::npos) {
      at.value.reset();
      report_.error(place, fmt::format("write the unit of the time: {0}ms or {0}s", time));
    }
    const auto* const word =
        std::find_if(kWords.begin(), kWords.end(), [&](const auto& known) { return what == known.first; });
    if (word == kWords.end()) {
      report_.error(place, base::in_quotes(what) + " cannot happen to a board" +
                               base::suggestion(what, {"kill", "cut", "return"}));
    }
    const auto found = std::find(boards_.begin(), boards_.end(), board);
    if (found == boards_.end()) {
      report_.error(place, "the plant has no board " + base::in_quotes(board) + base::suggestion(board, boards_));
    }
    if (at.value && word != kWords.end() && found != boards_.end()) {
      script_.events.push_back({*at.value, word->second, static_cast<std::size_t>(found - boards_.begin()),
                                fmt::format("{} {}", what, board), place});
    }
  }

  void check_end() {
    const auto late = std::find_if(script_.events.begin(), script_.events.end(),
                                   [this](const PlantEvent& event) { return end_ && event.at >= *end_; });
    for (auto event = late; event != script_.events.end(); ++event) {
      report_.warning(event->place, fmt::format("'{}' never happens: the run ends after {}", event->text,
                                                base::format_duration(*end_)));
    }
    script_.events.erase(late, script_.events.end());
  }

  void check_effects() {
    struct Board {
      bool runs = true;
      bool wired = true;
    };
    std::vector<Board> boards(boards_.size());
    for (const PlantEvent& event : script_.events) {
      Board& board = boards[event.board];
      const Board before = board;
      board.runs = event.what == What::Return || (board.runs && event.what != What::Kill);
      board.wired = event.what == What::Return || (board.wired && event.what != What::Cut);
      if (board.runs == before.runs && board.wired == before.wired) {
        report_.warning(event.place, fmt::format("'{}' changes nothing: the board {} then", event.text,
                                                 event.what == What::Return ? "is there"
                                                 : event.what == What::Kill ? "is down already"
                                                                            : "is cut off already"));
      }
    }
  }

  const std::vector<std::string>& boards_;
  std::optional<std::chrono::nanoseconds> end_;
  PlantScript& script_;
  base::Diagnostics report_;
};

}  // namespace

PlantScript read_script_text(std::string_view text, const std::string& file, const std::vector<std::string>& boards,
                             std::optional<std::chrono::nanoseconds> end) {
  PlantScript script;
  ScriptReader(file, boards, end, script).read(text);
  return script;
}

PlantScript read_script(const std::filesystem::path& file, const std::vector<std::string>& boards,
                        std::optional<std::chrono::nanoseconds> end) {
  const auto text = base::read_file(file, kMaxBytes);
  if (text) {
    return read_script_text(*text, file.string(), boards, end);
  }
  PlantScript script;
  script.diagnostics.push_back(
      {base::Diagnostic::Severity::Error, file.string(), {}, "cannot be read: " + text.error().text});
  return script;
}

}  // namespace indurop::node

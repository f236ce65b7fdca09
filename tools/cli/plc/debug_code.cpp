// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/debug_code.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <span>
#include <sstream>

#include "control/plc/model/identifier.h"
#include "control/plc/print/value_text.h"
#include "core/base/read_file.h"
#include "tools/client/plc/plc_path.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using Line = plc::DebugTable::Line;

// Returns "POU main, rung 3" for "POU main, rung 3, contact start".
std::string drawn_line(const std::string& within) {
  const std::size_t first = within.find(", ");
  const std::size_t second = first == std::string::npos ? first : within.find(", ", first + 2);
  return within.substr(0, second);
}

std::string name_of(const Line& line) {
  if (line.at.within != nullptr) {
    return drawn_line(*line.at.within);
  }
  const std::string file = line.at.file != nullptr ? std::filesystem::path(*line.at.file).filename().string() : "";
  return fmt::format("{}:{}", file, line.at.line);
}

std::optional<int> number_in(std::string_view text) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size() && value > 0 ? std::optional(value) : std::nullopt;
}

bool is_of_file(const Line& line, const std::string& file) {
  return line.at.file != nullptr && line.at.within == nullptr &&
         (file.empty() || *line.at.file == file || std::filesystem::path(*line.at.file).filename() == file);
}

// Returns the distance from the requested line down to this one; nothing if it does not match the request.
std::optional<int> distance(const Line& line, const std::string& what, const std::string& file) {
  const std::size_t colon = what.rfind(':');
  const auto number = number_in(colon == std::string::npos ? what : what.substr(colon + 1));
  if (number) {
    const std::string& wanted = colon == std::string::npos ? file : what.substr(0, colon);
    return is_of_file(line, wanted) && line.at.line >= *number ? std::optional(line.at.line - *number) : std::nullopt;
  }
  if (plc::same_name(line.pou->title(), what)) {
    return 0;
  }
  const std::string drawn = line.at.within == nullptr ? "" : plc::upper(drawn_line(*line.at.within));
  const std::string wanted = plc::upper(what);
  const std::size_t space = wanted.find(' ');
  const bool whole = space != std::string::npos &&
                     drawn == fmt::format("POU {}, {}", wanted.substr(0, space), wanted.substr(space + 1));
  return !drawn.empty() && (drawn.ends_with(", " + wanted) || whole) ? std::optional(0) : std::nullopt;
}

}  // namespace

const plc::ModuleText* DebugCode::module(std::string_view name) const {
  const auto found = std::find_if(compiled_.modules.begin(), compiled_.modules.end(),
                                  [&](const plc::ModuleText& one) { return one.name == name; });
  return found == compiled_.modules.end() ? nullptr : &*found;
}

const std::vector<std::string>& DebugCode::source(const std::string& file) {
  const auto [known, fresh] = sources_.try_emplace(file);
  if (!fresh) {
    return known->second;
  }
  const auto text = base::read_file(file);
  std::istringstream stream(text.ok() ? *text : std::string());
  for (std::string line; std::getline(stream, line);) {
    known->second.push_back(printable(line.ends_with('\r') ? line.substr(0, line.size() - 1) : line));
  }
  return known->second;
}

CodeLine DebugCode::line(const plc::DebugTable& table, std::uint32_t number) {
  const Line& line = table.lines.at(number);
  CodeLine made{name_of(line), ""};
  if (line.at.within == nullptr && line.at.file != nullptr) {
    const auto& lines = source(*line.at.file);
    const auto index = static_cast<std::size_t>(line.at.line);
    made.text = index > 0 && index <= lines.size() ? lines[index - 1] : "";
  }
  return made;
}

std::vector<std::string> DebugCode::around(const plc::DebugTable& table, std::uint32_t number) {
  const Line& line = table.lines.at(number);
  if (line.at.within != nullptr || line.at.file == nullptr) {
    return {name_of(line) + "; indurop plc print shows the drawing"};
  }
  const auto& lines = source(*line.at.file);
  constexpr int kAround = 5;
  std::vector<std::string> out;
  for (int i = std::max(1, line.at.line - kAround);
       i <= line.at.line + kAround && static_cast<std::size_t>(i) <= lines.size(); ++i) {
    out.push_back(fmt::format("{}{:5} {}", i == line.at.line ? ">" : " ", i, lines[static_cast<std::size_t>(i) - 1]));
  }
  return out;
}

std::optional<DebugCode::Breakpoint> DebugCode::find(const std::string& what, const std::string& file) {
  std::optional<int> nearest;
  std::optional<Breakpoint> out;
  for (const plc::ModuleText& module : compiled_.modules) {
    const auto& lines = module.debug.lines;
    for (std::uint32_t i = 0; i < lines.size(); ++i) {
      const auto away = distance(lines[i], what, file);
      if (!away || (nearest && *away > *nearest)) {
        continue;
      }
      if (!nearest || *away < *nearest) {
        nearest = away;
        out = Breakpoint{what, line(module.debug, i), {}};
      }
      // Only the first statement of the line in each body.
      auto& numbers = out->numbers[module.name];
      const bool known = std::any_of(numbers.begin(), numbers.end(),
                                     [&](std::uint32_t one) { return lines[one].pou == lines[i].pou; });
      if (!known) {
        numbers.push_back(i);
      }
    }
  }
  return out;
}

std::string debug_value(const plc::DebugTable& table, const DebugStop& stop, std::size_t frame,
                        const std::string& name) {
  const std::string path = plc::upper(name);
  const auto look = [&](const plc::FrameLayout& layout, const std::vector<std::uint8_t>& bytes) -> std::string {
    for (std::size_t end = path.size(); end != std::string::npos && end > 0; end = path.find_last_of(".[", end - 1)) {
      for (const plc::WatchedVariable& one : layout.variables) {
        const auto part =
            one.path == path.substr(0, end) ? part_of(*one.type, std::string_view(path).substr(end)) : std::nullopt;
        if (part && one.offset + part->offset < bytes.size()) {
          return plc::value_text(*part->type, std::span(bytes).subspan(one.offset + part->offset));
        }
      }
    }
    return "";
  };
  std::string found;
  if (frame < stop.frames.size() && stop.frames[frame].number < table.frames.size()) {
    found = look(table.frames[stop.frames[frame].number].layout, stop.frames[frame].values);
  }
  return found.empty() ? look(table.globals, stop.globals) : found;
}

std::vector<std::string> debug_values(const plc::FrameLayout& layout, const std::vector<std::uint8_t>& bytes) {
  std::vector<std::string> out;
  for (const plc::WatchedVariable& one : layout.variables) {
    const bool hidden = one.name.starts_with('_') || one.name.find("._") != std::string::npos;
    if (!hidden && one.offset < bytes.size()) {
      out.push_back(fmt::format("{} = {}", one.name, plc::value_text(*one.type, std::span(bytes).subspan(one.offset))));
    }
  }
  return out;
}

}  // namespace indurop::tools

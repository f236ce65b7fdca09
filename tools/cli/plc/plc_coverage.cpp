// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/plc/plc_coverage.h"

#include <fmt/format.h>
#include <indurop/plc/coverage.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <set>
#include <span>
#include <string_view>
#include <system_error>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"

namespace indurop::tools {
namespace {

using base::Problem;

constexpr std::uint64_t kMagic = iec::Coverage::kMagic;
constexpr std::size_t kHeadWords = iec::Coverage::kHeadWords;
constexpr std::size_t kFields = 6;

// Number of executions of lines, by file and number. For several statements in a line: the count of the one that ran
// most often.
using Runs = std::map<std::pair<std::string, int>, std::uint64_t>;

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> out;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t end = std::min(text.find(by, from), text.size());
    out.push_back(text.substr(from, end - from));
    from = end + 1;
  }
  return out;
}

template <class Number>
bool read_number(std::string_view text, Number& to) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
  return error == std::errc() && end == text.data() + text.size();
}

// Splits "POU main, rung 3, coil Motor" into "rung 3" and the rest.
std::pair<std::string, std::string> drawn_of(std::string_view within) {
  for (const std::string_view word : {", rung ", ", network "}) {
    if (const auto at = within.find(word); at != std::string_view::npos) {
      const std::string_view rest = within.substr(at + 2);
      const auto end = std::min(rest.find(", "), rest.size());
      return {std::string(rest.substr(0, end)), end < rest.size() ? std::string(rest.substr(end + 2)) : std::string()};
    }
  }
  return {};
}

// Parses one line of the text in a file of counters. Returns false if it is invalid.
bool add_point(std::string_view line, std::span<const std::uint64_t> counts, Coverage& coverage, Runs& runs) {
  const auto fields = split(line, '\t');
  std::size_t counter = 0;
  int number = 0;
  if (fields.size() != kFields || !read_number(fields[1], counter) || !read_number(fields[3], number) || number < 1) {
    return false;
  }
  const bool statement = fields[0] == "statement";
  if (counter >= counts.size() || counts.size() - counter < (statement ? 1 : 2)) {
    return false;
  }
  FileCoverage& file = coverage[std::string(fields[2])];
  auto [drawn, what] = drawn_of(fields[4]);
  if (statement) {
    FileCoverage::Line& one = file.lines[number];
    one.pou = std::string(fields[5]);
    one.drawn = drawn;
    std::uint64_t& most = runs[{std::string(fields[2]), number}];
    most = std::max(most, counts[counter]);
    return true;
  }
  const bool coil = fields[0] == "coil";
  FileCoverage::Outcome& one = file.outcomes[{number, coil ? what : std::string()}];
  one.what = coil ? what : std::string();
  one.pou = std::string(fields[5]);
  one.drawn = drawn;
  one.yes += counts[counter];
  one.no += counts[counter + 1];
  return true;
}

}  // namespace

Result<void, Problem> add_counters(const std::filesystem::path& path, Coverage& coverage) {
  const auto bytes = base::read_file(path);
  if (!bytes) {
    return Problem{fmt::format("cannot read {}", path.string())};
  }
  std::vector<std::uint64_t> words(bytes->size() / sizeof(std::uint64_t));
  std::memcpy(words.data(), bytes->data(), words.size() * sizeof(std::uint64_t));
  const Problem damaged{fmt::format("{} holds no counters of a PLC program", path.string())};
  if (words.size() < kHeadWords || words[0] != kMagic || words[1] > words.size() - kHeadWords) {
    return damaged;
  }
  const std::size_t head = (kHeadWords + words[1]) * sizeof(std::uint64_t);
  if (words[2] != bytes->size() - head) {
    return damaged;
  }
  const auto counts = std::span(words).subspan(kHeadWords, words[1]);
  const std::string_view text = std::string_view(*bytes).substr(head);
  Coverage added = coverage;
  Runs runs;
  for (const std::string_view line : split(text, '\n')) {
    if (!line.empty() && !add_point(line, counts, added, runs)) {
      return damaged;
    }
  }
  for (const auto& [place, count] : runs) {
    added[place.first].lines[place.second].runs += count;
  }
  coverage = std::move(added);
  return {};
}

std::string lcov_text(const Coverage& coverage) {
  std::string out;
  for (const auto& [name, file] : coverage) {
    std::error_code error;
    const auto whole = std::filesystem::canonical(name, error);
    out += fmt::format("TN:\nSF:{}\n", error ? name : whole.string());
    std::size_t hit = 0;
    std::size_t block = 0;
    for (const auto& [key, one] : file.outcomes) {
      const bool reached = one.yes + one.no > 0;
      const auto text = [&](std::uint64_t count) { return reached ? std::to_string(count) : std::string("-"); };
      out += fmt::format("BRDA:{0},{1},0,{2}\nBRDA:{0},{1},1,{3}\n", key.first, block++, text(one.yes), text(one.no));
      hit += (one.yes > 0 ? 1U : 0U) + (one.no > 0 ? 1U : 0U);
    }
    out += fmt::format("BRF:{}\nBRH:{}\n", 2 * file.outcomes.size(), hit);
    hit = 0;
    for (const auto& [line, one] : file.lines) {
      out += fmt::format("DA:{},{}\n", line, one.runs);
      hit += one.runs > 0 ? 1U : 0U;
    }
    out += fmt::format("LF:{}\nLH:{}\nend_of_record\n", file.lines.size(), hit);
  }
  return out;
}

namespace {

struct PlcCoverageRequest {
  std::string folder;
  std::string lcov;
};

// Formats numbers as "14, 17-18".
std::string ranges(const std::vector<int>& numbers) {
  std::string out;
  for (std::size_t i = 0; i < numbers.size();) {
    std::size_t end = i;
    while (end + 1 < numbers.size() && numbers[end + 1] == numbers[end] + 1) {
      ++end;
    }
    out += fmt::format("{}{}", out.empty() ? "" : ", ", numbers[i]);
    out += end > i ? fmt::format("-{}", numbers[end]) : "";
    i = end + 1;
  }
  return out;
}

// The coverage of a POU.
struct Part {
  std::size_t lines = 0;
  std::vector<int> left_lines;
  std::set<std::string> rungs;
  std::set<std::string> run_rungs;
  std::size_t outcomes = 0;
  std::size_t tried = 0;
  std::vector<std::string> left;  // missing outcomes, as text
};

std::map<std::string, Part> parts_of(const FileCoverage& file) {
  std::map<std::string, Part> parts;
  for (const auto& [number, line] : file.lines) {
    Part& part = parts[line.pou];
    if (!line.drawn.empty()) {
      part.rungs.insert(line.drawn);
      if (line.runs > 0) {
        part.run_rungs.insert(line.drawn);
      }
      continue;
    }
    ++part.lines;
    if (line.runs == 0) {
      part.left_lines.push_back(number);
    }
  }
  for (const auto& [key, one] : file.outcomes) {
    Part& part = parts[one.pou];
    part.outcomes += 2;
    part.tried += (one.yes > 0 ? 1U : 0U) + (one.no > 0 ? 1U : 0U);
    if (one.yes + one.no == 0) {
      continue;  // reported with its line or rung
    }
    const std::string where = one.drawn.empty() ? fmt::format("line {}", key.first) : one.drawn + ", " + one.what;
    const bool coil = !one.what.empty();
    if (one.yes == 0) {
      part.left.push_back(where + (coil ? " is never on" : " is never true"));
    }
    if (one.no == 0) {
      part.left.push_back(where + (coil ? " is never off" : " is never false"));
    }
  }
  return parts;
}

Cell share(std::size_t some, std::size_t all) {
  return all == 0 ? Cell("", nullptr)
                  : Cell(fmt::format("{}/{}", some, all), static_cast<double>(some) / static_cast<double>(all));
}

void print(Context& context, const Coverage& coverage) {
  Table table({{"FILE", "file"},
               {"POU", "pou"},
               {"LINES", "lines", Align::Right},
               {"RUNGS", "rungs", Align::Right},
               {"OUTCOMES", "outcomes", Align::Right},
               {"NOT TRIED", "not_tried"}});
  for (const auto& [name, file] : coverage) {
    for (const auto& [pou, part] : parts_of(file)) {
      std::vector<std::string> left;
      if (!part.left_lines.empty()) {
        left.push_back((part.left_lines.size() == 1 ? "line " : "lines ") + ranges(part.left_lines));
      }
      for (const std::string& rung : part.rungs) {
        if (!part.run_rungs.contains(rung)) {
          left.push_back(rung);
        }
      }
      left.insert(left.end(), part.left.begin(), part.left.end());
      std::string text;
      for (const std::string& one : left) {
        text += (text.empty() ? "" : "; ") + one;
      }
      table.add({Cell(name), Cell(pou), share(part.lines - part.left_lines.size(), part.lines),
                 share(part.run_rungs.size(), part.rungs.size()), share(part.tried, part.outcomes),
                 Cell(text, JsonValue(left))});
    }
  }
  print_table(context, table, {}, "pous");
}

}  // namespace

int show_coverage(Context& context, const std::filesystem::path& folder, const std::string& lcov) {
  Coverage coverage;
  std::vector<std::filesystem::path> files;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".plccov") {
      files.push_back(entry.path());
    }
  }
  if (files.empty()) {
    context.out.error(
        fmt::format("there are no counters in {}: build with indurop plc build --coverage, and run with "
                    "INDUROP_PLC_COVERAGE={}",
                    folder.string(), folder.string()));
    return kFailed;
  }
  std::sort(files.begin(), files.end());
  int code = kOk;
  for (const std::filesystem::path& file : files) {
    if (const auto added = add_counters(file, coverage); !added) {
      context.out.error(added.error().text);
      code = kFailed;
    }
  }
  print(context, coverage);
  if (!lcov.empty()) {
    if (const auto saved = base::replace_file(lcov, lcov_text(coverage), base::Durable::No); !saved) {
      context.out.error(base::cannot_write(lcov, saved.error()));
      return kFailed;
    }
  }
  return code;
}

void add_plc_coverage(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen) {
  auto request = std::make_shared<PlcCoverageRequest>();
  base::Options& made =
      app.command("coverage", "Show which lines, rungs and branches the tests covered", [request, chosen] {
        *chosen = [request](Context& c) { return show_coverage(c, request->folder, request->lcov); };
      });
  made.add("folder", "FOLDER", request->folder, "The folder that INDUROP_PLC_COVERAGE named while the tests ran")
      .required();
  made.add("--lcov", "FILE.info", request->lcov, "Also write it for lcov, genhtml and others")
      .completes(base::Completion::File);
  add_format_option(made, context, {Format::Table, Format::Json, Format::Csv});
}

}  // namespace indurop::tools

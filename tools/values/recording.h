// SPDX-License-Identifier: Apache-2.0
// Values over time as `indurop watch -o csv` writes them, read back for a chart.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"

namespace indurop::tools {

// One column: a number, a word (enumerators, text), true or false; or an array of numbers, drawn together.
struct Series {
  std::string name;
  std::vector<std::vector<double>> lines;  // of each element the values in time; NaN: none
  std::vector<std::string> words;          // what the numbers 0, 1, ... stand for, if they stand for words
  bool steps = false;                      // few values that hold until the next: drawn as a lane
  std::vector<std::string> parts{};        // what the lines of an array are called; empty: [0], [1], ...
};

struct Recording {
  std::vector<double> time_s;  // since the first row, or what triggered it; rising
  std::vector<Series> series;
  bool marked = false;  // 0 s is where it was triggered
};

// Whole numbers, not many different ones: better drawn as a lane.
bool few_whole_values(const std::vector<double>& line);

// What a line of it is called beside the others.
std::string part_name(const Series& series, std::size_t line);

// "NAME=OTHER": shown by another name, NAME[2]=OTHER: a line of an array. NAME may lack its namespace. What is wrong,
// or nothing.
std::optional<std::string> rename(Recording& recording, std::string_view rule);
// "NAME=0 off, 1 on": words for numbers.
std::optional<std::string> give_words(Recording& recording, std::string_view rule);
// Takes a column out, to be drawn otherwise; nothing if there is none of this name.
std::optional<Series> take_series(Recording& recording, std::string_view name);
// Leaves out the namespace that all names begin with.
void drop_common_namespace(Recording& recording);

// What `indurop watch -o csv` wrote; `name` is the file in the error.
Result<Recording, base::Diagnostic> read_recording(std::string_view text, const std::string& name);

}  // namespace indurop::tools

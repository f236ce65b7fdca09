// SPDX-License-Identifier: Apache-2.0
// Values over time, read from the output of `indurop watch -o csv` for a chart.

#pragma once

#include <indurop/result.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/diagnostic.h"

namespace indurop::tools {

// One column: a number, a word (enumerators, text), true or false; or an array of numbers that are drawn together.
struct Series {
  std::string name;
  std::vector<std::vector<double>> lines;  // the values over time of each element; NaN: none
  std::vector<std::string> words;          // the words for the numbers 0, 1, ..., if they stand for words
  bool steps = false;                      // few values that hold until the next one: drawn as a lane
  std::vector<std::string> parts{};        // names of the lines of an array; empty: [0], [1], ...
};

struct Recording {
  std::vector<double> time_s;  // since the first row, or the trigger; ascending
  std::vector<Series> series;
  bool marked = false;  // 0 s is the time of the trigger
};

// Returns true if all are whole numbers with few different values: better drawn as a lane.
bool few_whole_values(const std::vector<double>& line);

// Returns the name of one line of the series.
std::string part_name(const Series& series, std::size_t line);

// Applies "NAME=OTHER" (shown by another name) or NAME[2]=OTHER (a line of an array). NAME may lack its namespace.
// Returns what is wrong, or nothing.
std::optional<std::string> rename(Recording& recording, std::string_view rule);
// Applies "NAME=0 off, 1 on": words for numbers.
std::optional<std::string> give_words(Recording& recording, std::string_view rule);
// Removes a column, to be drawn in another way; returns nothing if there is none of this name.
std::optional<Series> take_series(Recording& recording, std::string_view name);
// Removes the namespace that all names begin with.
void drop_common_namespace(Recording& recording);

// Parses the output of `indurop watch -o csv`; `name` is the file name for the error.
Result<Recording, base::Diagnostic> read_recording(std::string_view text, const std::string& name);

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/replayed_over.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "core/base/csv_row.h"

namespace indurop::tools {
namespace {

using base::Problem;

constexpr std::size_t kMostColumns = 20;

struct ReplayedOverRow {
  std::int64_t time_ns = 0;
  std::vector<std::string> cells;
};

struct ReadSheet {
  std::vector<std::string> names;
  std::vector<ReplayedOverRow> rows;

  [[nodiscard]] std::optional<std::size_t> column(const std::string& name) const {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - names.begin()));
  }
};

std::optional<ReadSheet> read(std::string_view text) {
  ReadSheet sheet;
  std::size_t line = 1;
  for (bool heading = true; !text.empty(); heading = false) {
    std::vector<base::CsvCell> cells = base::take_csv_row(text, ',', line);
    ReplayedOverRow row;
    const std::string& time = cells.front().text;
    if (!heading && std::from_chars(time.data(), time.data() + time.size(), row.time_ns).ec != std::errc()) {
      return std::nullopt;
    }
    for (std::size_t i = 1; i < cells.size(); ++i) {
      row.cells.push_back(std::move(cells[i].text));
    }
    if (heading) {
      sheet.names = std::move(row.cells);
    } else if (row.cells.size() == sheet.names.size()) {
      sheet.rows.push_back(std::move(row));
    } else {
      return std::nullopt;
    }
  }
  return sheet;
}

// Merges the rows of both by time: calls `use(time, recorded, now)` with the rows that hold then; null: none yet.
template <class Use>
void for_each_time(const ReadSheet& recorded, const ReadSheet& now, const Use& use) {
  const ReplayedOverRow* left = nullptr;
  const ReplayedOverRow* right = nullptr;
  std::size_t i = 0;
  std::size_t j = 0;
  while (i < recorded.rows.size() || j < now.rows.size()) {
    const bool more =
        j >= now.rows.size() || (i < recorded.rows.size() && recorded.rows[i].time_ns <= now.rows[j].time_ns);
    const std::int64_t time = more ? recorded.rows[i].time_ns : now.rows[j].time_ns;
    if (i < recorded.rows.size() && recorded.rows[i].time_ns == time) {
      left = &recorded.rows[i++];
    }
    if (j < now.rows.size() && now.rows[j].time_ns == time) {
      right = &now.rows[j++];
    }
    use(time, left, right);
  }
}

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;  // columns of the same name

Pairs differing(const ReadSheet& recorded, const ReadSheet& now) {
  Pairs pairs;
  std::vector<bool> differ;
  for (std::size_t i = 0; i < recorded.names.size(); ++i) {
    if (const auto other = now.column(recorded.names[i])) {
      pairs.emplace_back(i, *other);
    }
  }
  differ.resize(pairs.size());
  for_each_time(recorded, now, [&](std::int64_t, const ReplayedOverRow* left, const ReplayedOverRow* right) {
    for (std::size_t k = 0; left != nullptr && right != nullptr && k < pairs.size(); ++k) {
      const std::string& one = left->cells[pairs[k].first];
      const std::string& other = right->cells[pairs[k].second];
      differ[k] = differ[k] || (!one.empty() && !other.empty() && one != other);
    }
  });
  std::size_t k = 0;
  std::erase_if(pairs, [&](const auto&) { return !differ[k++]; });
  return pairs;
}

std::string together(const ReadSheet& recorded, const ReadSheet& now, const Pairs& pairs) {
  std::string text = "time_ns";
  for (const auto& [i, j] : pairs) {
    text += "," + base::csv_field(recorded.names[i] + " recorded") + "," + base::csv_field(now.names[j] + " now");
  }
  text += '\n';
  for_each_time(recorded, now, [&](std::int64_t time, const ReplayedOverRow* left, const ReplayedOverRow* right) {
    text += std::to_string(time);
    for (const auto& [i, j] : pairs) {
      text += "," + (left == nullptr ? std::string() : base::csv_field(left->cells[i]));
      text += "," + (right == nullptr ? std::string() : base::csv_field(right->cells[j]));
    }
    text += '\n';
  });
  return text;
}

}  // namespace

Result<Recording, Problem> laid_over(const std::string& recorded, const std::string& prefix, const std::string& now,
                                     std::size_t& left_out) {
  auto before = read(recorded);
  const auto after = read(now);
  if (!before || !after) {
    return Problem{"a recording's values cannot be read"};
  }
  for (std::string& name : before->names) {
    name.erase(0, name.starts_with(prefix) ? prefix.size() : 0);
  }
  Pairs pairs = differing(*before, *after);
  left_out = pairs.size() - std::min(pairs.size(), kMostColumns);
  pairs.resize(pairs.size() - left_out);
  if (pairs.empty()) {
    return Recording();
  }
  auto both = read_recording(together(*before, *after, pairs), "replay");
  if (!both) {
    return Problem{both.error().text};
  }
  Recording out = std::move(*both);
  for (std::size_t k = 0; k < out.series.size(); ++k) {
    out.series[k].name = before->names[pairs[k / 2].first];
  }
  drop_common_namespace(out);
  std::vector<Series> series;
  for (std::size_t k = 0; k + 1 < out.series.size(); k += 2) {
    Series& one = out.series[k];
    Series& other = out.series[k + 1];
    const bool lines = !one.steps && !other.steps && one.words.empty() && other.words.empty() && !one.lines.empty() &&
                       !other.lines.empty();
    if (lines) {
      one.lines.push_back(std::move(other.lines.front()));
      one.parts = {"recorded", "now"};
    }
    series.push_back(std::move(one));
    if (!lines) {
      other.name = "now";
      series.push_back(std::move(other));
    }
  }
  out.series = std::move(series);
  return out;
}

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "tools/testing/golden.h"

#include <fmt/format.h>

#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "core/base/csv_row.h"
#include "core/base/file_problem.h"
#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"

namespace indurop::testing {
namespace {

std::string line_of(const std::string& first, const std::vector<std::string>& fields) {
  std::string line = first;
  for (const std::string& field : fields) {
    line += ',' + base::csv_field(field);
  }
  return line + '\n';
}

std::vector<std::string> fields_of(const std::string& line) {
  std::string_view rest = line;
  std::size_t number = 1;
  std::vector<std::string> fields;
  for (base::CsvCell& cell : base::take_csv_row(rest, ',', number)) {
    fields.push_back(std::move(cell.text));
  }
  return fields;
}

// Returns the difference between two lines of the same tick, with the name of the column.
std::string difference(const std::string& is, const std::string& was, const std::vector<std::string>& names) {
  const auto now = fields_of(is);
  const auto before = fields_of(was);
  if (now.empty() || before.empty() || now[0] != before[0]) {
    return fmt::format("tick {}: something changed, where the next change was in tick {}", now.empty() ? "" : now[0],
                       before.empty() ? "" : before[0]);
  }
  for (std::size_t i = 1; i < now.size() && i < before.size() && i <= names.size(); ++i) {
    if (now[i] != before[i]) {
      return fmt::format("tick {}: {} is {}, was {}", now[0], names[i - 1], now[i], before[i]);
    }
  }
  return fmt::format("tick {}: another number of columns", now[0]);
}

}  // namespace

void Trace::begin(std::vector<std::string> names) {
  names_ = std::move(names);
  rows_.clear();
}

void Trace::add(std::uint64_t tick, std::vector<std::string> values) {
  if (rows_.empty() || rows_.back().values != values) {
    rows_.push_back({tick, std::move(values)});
  }
}

std::string Trace::csv() const {
  std::string text = line_of("tick", names_);
  for (const Row& row : rows_) {
    text += line_of(std::to_string(row.tick), row.values);
  }
  return text;
}

std::string Trace::difference_to(const std::filesystem::path& file) const {
  const char* update = std::getenv("INDUROP_UPDATE_GOLDEN");  // NOLINT(concurrency-mt-unsafe): read only
  if (update != nullptr && std::string(update) == "1") {
    if (const auto saved = base::replace_file(file, csv(), base::Durable::No); !saved) {
      throw std::runtime_error(base::cannot_write(file, saved.error()));
    }
    return {};
  }
  const auto text = base::read_file(file);
  if (!text) {
    throw std::runtime_error(base::cannot_read(file, text.error()) +
                             "; INDUROP_UPDATE_GOLDEN=1 in the environment writes it");
  }
  const std::vector<std::string> is = base::lines_of(csv());
  const std::vector<std::string> was = base::lines_of(*text);
  if (is[0] != (was.empty() ? "" : was[0])) {
    return fmt::format("{} is about other variables: {}", file.string(), was.empty() ? "none" : was[0]);
  }
  for (std::size_t i = 1; i < is.size() && i < was.size(); ++i) {
    if (is[i] != was[i]) {
      return difference(is[i], was[i], names_);
    }
  }
  if (is.size() != was.size()) {
    const bool more = is.size() > was.size();
    const auto row = fields_of(more ? is[was.size()] : was[is.size()]);
    return fmt::format(
        "tick {}: {}", row.empty() ? "" : row[0],
        more ? "something changed that did not before" : "nothing changed any more, where something did before");
  }
  return {};
}

}  // namespace indurop::testing

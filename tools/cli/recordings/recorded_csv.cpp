// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recorded_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/csv_row.h"
#include "core/schema/schema.h"
#include "history/recorder/sources.h"
#include "history/recording/idl_layout.h"
#include "history/recording/mcap_reader.h"

namespace indurop::tools {
namespace {

using base::Problem;

// A channel with its values as columns. Channels of one variable whose type has changed have those of one name in
// common.
struct Columns {
  std::vector<recording::IdlLeaf> layout;
  std::vector<std::size_t> places;  // in the row, by leaf
};

class CsvSheet {
 public:
  explicit CsvSheet(const CsvOptions& options) : options_(options) {}

  Result<void, Problem> choose(const recording::McapReader& reader) {
    const recorder::Sources sources = recorder::find_sources(reader);
    std::vector<bool> found(options_.names.size(), false);
    for (const auto& [id, channel] : reader.contents().channels) {
      const auto place = sources.channels.find(id);
      const bool own = place != sources.channels.end() && place->second.kind != recorder::ChannelKind::Value;
      const auto schema = reader.contents().schemas.find(channel.schema);
      if (own || schema == reader.contents().schemas.end() || channel.encoding != "cdr" ||
          !wanted(channel.topic, found)) {
        continue;
      }
      if (auto layout = recording::idl_layout(schema->second.data, schema->second.name)) {
        add(id, channel, std::move(layout).value());
      }
    }
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (!found[i]) {
        return Problem{
            fmt::format("there is no variable '{}' in the recording; see indurop recording info", options_.names[i])};
      }
    }
    cells_.resize(heading_.size());
    return {};
  }

  std::string heading() const {
    std::string line = "time_ns";
    for (const std::string& name : heading_) {
      line += "," + base::csv_field(name);
    }
    return line + "\n";
  }

  void take(const recording::McapMessage& message) {
    const auto columns = columns_.find(message.channel);
    if (columns == columns_.end() || !recording::read_leaf_texts(columns->second.layout, message.data.view, texts_)) {
      return;
    }
    const std::vector<std::size_t>& places = columns->second.places;
    if (std::equal(texts_.begin(), texts_.end(), places.begin(), places.end(),
                   [this](const std::string& text, std::size_t place) { return text == cells_[place]; })) {
      return;
    }
    const auto time = static_cast<std::int64_t>(message.log_time_ns);
    write_rows_before(time);
    for (std::size_t i = 0; i < places.size(); ++i) {
      cells_[places[i]] = texts_[i];
    }
    time_ns_ = time_ns_ ? time_ns_ : time;
    changed_ = true;
    changed_ns_ = time;
  }

  // Writes the last row too.
  Exported finish() {
    write_rows_before(changed_ns_ + 1);
    return std::move(out);
  }

  Exported out;

 private:
  bool wanted(const std::string& topic, std::vector<bool>& found) const {
    bool any = options_.names.empty();
    for (std::size_t i = 0; i < options_.names.size(); ++i) {
      if (schema::glob_match(options_.names[i], topic)) {
        found[i] = true;
        any = true;
      }
    }
    return any;
  }

  void add(std::uint16_t id, const recording::McapChannel& channel, std::vector<recording::IdlLeaf> layout) {
    const auto unit = channel.metadata.find("unit");
    const bool shown = options_.units && unit != channel.metadata.end();
    Columns columns{std::move(layout), {}};
    for (const recording::IdlLeaf& leaf : columns.layout) {
      const std::string name = channel.topic + leaf.name;
      const std::string title = shown ? fmt::format("{} [{}]", name, unit->second) : name;
      const auto [known, is_new] = by_title_.emplace(title, heading_.size());
      columns.places.push_back(known->second);
      if (is_new) {
        heading_.push_back(title);
      }
    }
    columns_.emplace(id, std::move(columns));
  }

  // Writes the values that held until now, before another one changes.
  void write_rows_before(std::int64_t time) {
    if (!time_ns_) {
      return;
    }
    if (options_.every_ns == 0) {
      if (changed_ && changed_ns_ < time) {
        write_row(changed_ns_);
        changed_ = false;
      }
      return;
    }
    for (; *time_ns_ < time; *time_ns_ += options_.every_ns) {
      write_row(*time_ns_);
    }
  }

  void write_row(std::int64_t time) {
    out.text += std::to_string(time);
    for (const std::string& cell : cells_) {
      out.text += "," + base::csv_field(cell);
    }
    out.text += '\n';
    ++out.count;
  }

  const CsvOptions& options_;
  std::map<std::uint16_t, Columns> columns_;
  std::vector<std::string> heading_;
  std::map<std::string, std::size_t> by_title_;  // places in it
  std::vector<std::string> cells_;
  std::vector<std::string> texts_;
  std::optional<std::int64_t> time_ns_;  // time of the next row, with --every
  bool changed_ = false;
  std::int64_t changed_ns_ = 0;
};

}  // namespace

Result<Exported, Problem> recorded_csv(const std::filesystem::path& file, const CsvOptions& options) {
  auto reader = recording::McapReader::open(file);
  if (!reader) {
    return std::move(reader).error();
  }
  CsvSheet sheet(options);
  if (auto chosen = sheet.choose(*reader); !chosen) {
    return std::move(chosen).error();
  }
  sheet.out.text = sheet.heading();
  sheet.out.damages = reader->each([&sheet](const recording::McapMessage& message) { sheet.take(message); });
  return sheet.finish();
}

}  // namespace indurop::tools

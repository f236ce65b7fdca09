// SPDX-License-Identifier: Apache-2.0
#include "tools/client/scope/save.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "core/base/csv_row.h"
#include "history/recording/cdr.h"
#include "history/recording/mcap_writer.h"
#include "history/recording/omg_idl.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using base::Problem;

// Calls `use` with each line's channel, name and values.
template <class Use>
void for_each_line(const Capture& capture, Use use) {
  std::size_t at = 0;
  for (const ScopeChannel& channel : capture.channels) {
    for (const ScopeLine& line : channel.lines) {
      use(channel, line.name, capture.lines[at++]);
    }
  }
}

bool all_have_words(const std::vector<double>& line, const std::vector<std::string>& words) {
  return std::all_of(line.begin(), line.end(), [&](double value) {
    return std::isnan(value) ||
           (value >= 0 && value < static_cast<double>(words.size()) && !words[static_cast<std::size_t>(value)].empty());
  });
}

std::string text_of(const ScopeChannel& channel, double value) {
  if (std::isnan(value)) {
    return {};
  }
  if (channel.yes_no) {
    return value != 0 ? "true" : "false";
  }
  const bool word = value >= 0 && value < static_cast<double>(channel.words.size());
  return word ? channel.words[static_cast<std::size_t>(value)] : fmt::format("{}", value);
}

std::string name_with_unit(const ScopeChannel& channel) {
  return channel.unit.empty() ? channel.name : fmt::format("{} [{}]", channel.name, channel.unit);
}

std::int64_t trigger_ns(const Capture& capture) {
  return static_cast<std::int64_t>(capture.trigger_row.value_or(0)) * capture.period_ns;
}

}  // namespace

std::string heading_of(const Capture& capture) {
  const std::string every = human_ns(capture.period_ns);
  if (!capture.trigger_row) {
    return fmt::format("{} ticks from tick {} on, every {}{}", capture.rows(), capture.first_tick, every,
                       capture.trigger.empty() ? "" : ", without a trigger");
  }
  return fmt::format("{} at tick {}, {} ticks before and {} after, every {}", printable(capture.trigger),
                     capture.first_tick + *capture.trigger_row, *capture.trigger_row,
                     capture.rows() - *capture.trigger_row - 1, every);
}

Recording recording_of(const Capture& capture) {
  Recording out;
  out.marked = capture.trigger_row.has_value();
  for (std::size_t row = 0; row < capture.rows(); ++row) {
    out.time_s.push_back(static_cast<double>(static_cast<std::int64_t>(row) * capture.period_ns - trigger_ns(capture)) /
                         1e9);
  }
  std::size_t at = 0;
  for (const ScopeChannel& channel : capture.channels) {
    Series series{name_with_unit(channel), {}, {}, false};
    for (std::size_t i = 0; i < channel.lines.size(); ++i) {
      series.lines.push_back(capture.lines[at++]);
    }
    if (series.lines.size() == 1) {
      const std::vector<double>& line = series.lines.front();
      series.steps = channel.yes_no || few_whole_values(line);
      series.words = series.steps && all_have_words(line, channel.words) ? channel.words : std::vector<std::string>();
    }
    out.series.push_back(std::move(series));
  }
  return out;
}

std::string csv_of(const Capture& capture) {
  std::string out = "time_ns";
  for_each_line(capture, [&](const ScopeChannel& /*channel*/, const std::string& name, const auto& /*values*/) {
    out += "," + base::csv_field(name);
  });
  out += '\n';
  for (std::size_t row = 0; row < capture.rows(); ++row) {
    out += std::to_string(capture.first_wall_ns + static_cast<std::int64_t>(row) * capture.period_ns);
    for_each_line(capture, [&](const ScopeChannel& channel, const std::string& /*name*/, const auto& values) {
      out += "," + base::csv_field(text_of(channel, values[row]));
    });
    out += '\n';
  }
  return out;
}

base::Json json_of(const Capture& capture) {
  base::Json out = base::Json::object();
  out["period_ns"] = capture.period_ns;
  out["first_tick"] = capture.first_tick;
  out["first_ns"] = capture.first_ns;
  out["first_wall_ns"] = capture.first_wall_ns;
  out["rows"] = capture.rows();
  out["trigger"] = capture.trigger;
  out["trigger_row"] = capture.trigger_row ? base::Json(*capture.trigger_row) : base::Json();
  out["lost_runs"] = capture.lost_runs;
  base::Json lines = base::Json::array();
  for_each_line(capture, [&](const ScopeChannel& channel, const std::string& name, const auto& values) {
    base::Json line = base::Json::object();
    line["name"] = name;
    line["channel"] = channel.name;
    line["unit"] = channel.unit;
    if (!channel.words.empty()) {
      line["words"] = base::Json(channel.words);
    }
    base::Json numbers = base::Json::array();
    for (const double value : values) {
      numbers.push_back(std::isfinite(value) ? base::Json(value) : base::Json());
    }
    line["values"] = std::move(numbers);
    lines.push_back(std::move(line));
  });
  out["lines"] = std::move(lines);
  return out;
}

Result<void, Problem> save_mcap(const std::filesystem::path& path, const Capture& capture, const std::string& node) {
  auto writer = recording::McapWriter::create(path, {});
  if (!writer) {
    return std::move(writer).error();
  }
  schema::Type number;
  number.base = schema::Base::Double;
  number.element_size = schema::size_of(number.base);
  number.align = number.element_size;
  const recording::OmgIdl idl = recording::omg_idl(number);
  const auto schema = writer->add_schema(idl.name, "omgidl", idl.text);
  if (!schema) {
    return schema.error();
  }
  std::vector<std::pair<std::uint16_t, const std::vector<double>*>> channels;
  Result<void, Problem> result;
  for_each_line(capture, [&](const ScopeChannel& channel, const std::string& name, const auto& values) {
    const auto id = writer->add_channel(*schema, name, "cdr", {{"unit", channel.unit}});
    if (id) {
      channels.emplace_back(*id, &values);
    } else if (result) {
      result = id.error();
    }
  });
  std::vector<std::uint8_t> cdr;
  for (std::size_t row = 0; row < capture.rows() && result; ++row) {
    const auto time =
        static_cast<std::uint64_t>(capture.first_wall_ns + static_cast<std::int64_t>(row) * capture.period_ns);
    for (const auto& [id, values] : channels) {
      const auto bytes = std::bit_cast<std::array<std::uint8_t, sizeof(double)>>((*values)[row]);
      if (!result || std::isnan((*values)[row]) || !recording::to_cdr(number, bytes, cdr).ok()) {
        continue;
      }
      result = writer->write(id, time, time, static_cast<std::uint32_t>(row), cdr);
    }
  }
  if (result) {
    const std::string tick =
        capture.trigger_row ? std::to_string(capture.first_tick + *capture.trigger_row) : std::string();
    result = writer->metadata("indurop.scope", {{"node", node},
                                                {"trigger", capture.trigger},
                                                {"trigger_tick", tick},
                                                {"period_ns", std::to_string(capture.period_ns)}});
  }
  return result ? writer->close() : result;
}

}  // namespace indurop::tools

// SPDX-License-Identifier: Apache-2.0
#include "tools/cli/recordings/recording_info.h"
#include "tools/console/table_text.h"

#include <fmt/format.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include "core/rt/clock.h"
#include "history/recorder/survey.h"
#include "tools/client/text/table.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

using recorder::Survey;

// Returns "2026-11-22 03:12:04.120"; for virtual time "12.5 s".
std::string time_text(std::int64_t ns) {
  constexpr std::int64_t kVirtual = std::int64_t{365} * 86'400 * rt::kNanosPerSecond;  // no real clock is in 1970
  constexpr std::int64_t kNsPerMs = 1'000'000;
  if (ns < kVirtual) {
    return human_ns(ns);
  }
  return fmt::format("{}.{:03}", local_time(ns), ns % rt::kNanosPerSecond / kNsPerMs);
}

Table modules_of(const Survey& survey) {
  constexpr Align kRight = Align::Right;
  Table table({{"BOARD", "board"},
               {"MODULE", "module"},
               {"RUNS", "runs", kRight},
               {"FIRST TICK", "first_tick", kRight},
               {"LAST TICK", "last_tick", kRight},
               {"RUNS BEFORE", "runs_before", kRight},
               {"LOST", "lost_runs", kRight},
               {"FAULTS", "faults", kRight}});
  const auto number = [](std::uint64_t value) { return Cell(std::to_string(value), value); };
  for (const recorder::SurveyedModule& module : survey.modules) {
    table.add({Cell(printable(survey.sources.all[module.source].name())), Cell(printable(module.name), Style::Bold),
               number(module.runs), number(module.first_tick), number(module.last_tick), number(module.before),
               number(module.lost), number(module.faults)});
  }
  return table;
}

Table channels_of(const Survey& survey) {
  Table table({{"CHANNEL", "channel"},
               {"TYPE", "type"},
               {"UNIT", "unit"},
               {"MESSAGES", "messages", Align::Right},
               {"DROPPED", "dropped", Align::Right}});
  for (const recorder::SurveyedChannel& channel : survey.channels) {
    table.add({Cell(printable(channel.name), Style::Bold), Cell(printable(channel.type)), Cell(printable(channel.unit)),
               Cell(std::to_string(channel.messages), channel.messages),
               Cell(channel.dropped == 0 ? "" : std::to_string(channel.dropped), channel.dropped)});
  }
  return table;
}

JsonValue nodes_of(const Survey& survey) {
  JsonValue nodes = JsonValue::array();
  for (const recorder::Source& source : survey.sources.all) {
    JsonValue node = JsonValue::object();
    for (const auto& [name, value] : source.about) {
      node[name] = value;
    }
    nodes.push_back(node);
  }
  return nodes;
}

void print_head(Context& context, const std::filesystem::path& file, const Survey& survey) {
  context.out.line(fmt::format("{}: {} to {}, {}, {} messages, {}{}", file.string(), time_text(survey.begin_ns),
                               time_text(survey.end_ns), human_ns(survey.end_ns - survey.begin_ns), survey.messages,
                               human_bytes(survey.bytes), survey.closed ? "" : ", was not closed"));
  for (const recorder::Source& source : survey.sources.all) {
    std::string line;
    for (const char* name : {"node", "board", "config", "deployment", "reason"}) {
      if (const std::string text = source.text(name); !text.empty()) {
        line += fmt::format("{}{} {}", line.empty() ? "" : ", ", name, printable(text));
      }
    }
    context.out.line(line);
  }
  std::string attached;
  for (const std::string& name : survey.attachments) {
    attached += (attached.empty() ? "" : ", ") + printable(name);
  }
  if (!attached.empty()) {
    context.out.line("inside: " + attached);
  }
}

}  // namespace

int show_recording(Context& context, const std::filesystem::path& file) {
  const auto survey = recorder::survey(file);
  if (!survey) {
    context.out.error(survey.error().text);
    return kFailed;
  }
  if (context.format == Format::Table) {
    print_head(context, file, *survey);
    const Table modules = modules_of(*survey);
    context.out.write(modules.empty() ? "" : "\n" + table_text(modules, context.out));
    context.out.line("");
  }
  print_table(context, channels_of(*survey),
              {{"file", file.string()},
               {"begin_ns", survey->begin_ns},
               {"end_ns", survey->end_ns},
               {"bytes", survey->bytes},
               {"messages", survey->messages},
               {"closed", survey->closed},
               {"nodes", nodes_of(*survey)},
               {"attachments", survey->attachments},
               {"damages", survey->damages},
               {"modules", modules_of(*survey).json()}},
              "channels");
  for (const std::string& damage : survey->damages) {
    context.out.note(damage);
  }
  return kOk;
}

void add_recording_info(base::Options& app, Context& context, const std::shared_ptr<Action>& chosen) {
  auto file = std::make_shared<std::filesystem::path>();
  base::Options& verb = app.command("info", "Show what a recording contains, and what is missing", [file, chosen] {
    *chosen = [file](Context& c) { return show_recording(c, *file); };
  });
  verb.add("file", "FILE.mcap", *file, "The recording").required().completes(base::Completion::File);
  add_format_option(verb, context, {Format::Table, Format::Json, Format::Csv});
  verb.details(
      "RUNS BEFORE are runs before the recording began. LOST are runs that were overwritten before they were read.\n"
      "DROPPED are the lost runs of the modules that write a variable: so many changes of it may be missing.\n"
      "Damaged parts are skipped and named.\n");
}

}  // namespace indurop::tools

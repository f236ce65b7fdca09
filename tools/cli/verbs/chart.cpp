// SPDX-License-Identifier: Apache-2.0
// indurop chart: draws values over time.
#include <fmt/format.h>

#include <iostream>
#include <iterator>
#include <optional>
#include <utility>

#include "core/base/read_file.h"
#include "core/base/replace_file.h"
#include "core/base/text.h"
#include "tools/cli/pictures/chart_text.h"
#include "tools/cli/pictures/recording_svg.h"
#include "tools/cli/verbs/verbs.h"

namespace indurop::tools {
namespace {

struct ChartOptions {
  std::string file;
  std::string svg_file;
  std::string title;
  std::string way;
  std::vector<std::string> names;
  std::vector<std::string> words;
};

bool name_columns(Context& context, const ChartOptions& options, Recording& recording) {
  std::vector<std::string> problems;
  for (const std::string& rule : options.words) {
    if (auto problem = give_words(recording, rule)) {
      problems.push_back("--words: " + *problem);
    }
  }
  for (const std::string& rule : options.names) {
    if (auto problem = rename(recording, rule)) {
      problems.push_back("--name: " + *problem);
    }
  }
  for (const std::string& problem : problems) {
    context.out.error(problem);
  }
  drop_common_namespace(recording);
  return problems.empty();
}

int chart(Context& context, const ChartOptions& options) {
  const bool piped = options.file == "-";
  std::string text;
  if (piped) {
    text.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else if (auto content = base::read_file(options.file)) {
    text = std::move(*content);
  } else {
    context.out.error(
        fmt::format("cannot read '{}': {}; record one with `indurop watch NAME... -o csv > {}`, or give - "
                    "and pipe it in",
                    options.file, content.error().text, options.file));
    return kFailed;
  }
  auto read = read_recording(text, piped ? "stdin" : options.file);
  if (!read) {
    context.out.message_line(base::to_string(read.error()));
    return kFailed;
  }
  Recording recording = std::move(read).value();
  std::optional<Series> way;
  if (!options.way.empty()) {
    way = take_series(recording, options.way);
    if (!way || way->lines.size() < 2) {
      context.out.error(fmt::format("--way: {} is no column of x, y and z", base::in_quotes(options.way)));
      return kUsage;
    }
    const std::size_t space = way->name.rfind("::");
    way->name.erase(0, space == std::string::npos ? 0 : space + 2);
  }
  if (!name_columns(context, options, recording)) {
    return kUsage;
  }
  if (options.svg_file.empty() && context.format == Format::Table) {
    for (const std::string& line : chart_lines(recording, context.out.extent().columns, context.out.unicode())) {
      context.out.line(line);
    }
    return kOk;
  }
  const std::string picture =
      chart_svg(options.title.empty() ? options.file : options.title, recording, way ? &*way : nullptr);
  if (options.svg_file.empty()) {
    context.out.write(picture);
    return kOk;
  }
  if (const auto saved = base::replace_file(options.svg_file, picture, base::Durable::No); !saved) {
    context.out.error(base::cannot_write(options.svg_file, saved.error()));
    return kFailed;
  }
  context.out.note(fmt::format("wrote {}", options.svg_file));
  return kOk;
}

Action declare_chart(base::Options& app, Context& context) {
  auto options = std::make_shared<ChartOptions>();
  app.add("file", "FILE.csv", options->file, "Recording; - reads it from stdin").required();
  app.add("--svg", "FILE", options->svg_file, "Write a picture to FILE");
  app.add("--title", "TEXT", options->title, "Heading of the picture");
  app.add("--way", "NAME", options->way, "Draw an array of x, y, z as a path, from above and from the side");
  app.add("--name", "OLD=NEW", options->names, "Show a column, or NAME[2] of an array, by another name (repeat it)");
  app.add("--words", "NAME=0 off, 1 on", options->words, "Show words instead of a column's numbers (repeat it)");
  add_format_option(app, context, {Format::Table, Format::Svg});
  return [options](Context& c) { return chart(c, *options); };
}

}  // namespace

const Verb kChartVerb{
    "chart", "Variables", "Draw recorded values over time, in the terminal or as SVG",
    "Reads what `indurop watch -o csv` wrote. Numbers are drawn as lines, with the elements of an array together.\n"
    "Variables that have few values (bool, enumerators, small counters) are drawn as a lane of bars.\n"
    "Examples:\n"
    "  indurop watch 'joints' motor_on state --hz 50 --timeout 20s -o csv > run.csv\n"
    "  indurop chart run.csv\n"
    "  indurop chart run.csv --svg run.svg --title 'First run'\n"
    "  indurop chart run.csv --name 'joints[0]=J1' --words 'state=0 idle, 1 moves'\n",
    &declare_chart};

}  // namespace indurop::tools

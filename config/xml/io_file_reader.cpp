// SPDX-License-Identifier: Apache-2.0
#include "config/xml/io_file_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "config/xml/element_rules.h"
#include "core/base/text.h"

namespace indurop::config {

namespace {

bool is_word(std::string_view text) {
  return !text.empty() && std::isdigit(static_cast<unsigned char>(text.front())) == 0 &&
         std::all_of(text.begin(), text.end(),
                     [](unsigned char c) { return c < 0x80 && (std::isalnum(c) != 0 || c == '_'); });
}

bool is_namespace(std::string_view text) {
  for (std::size_t end = 0; end != std::string_view::npos; text.remove_prefix(std::min(end + 2, text.size()))) {
    end = text.find("::");
    if (!is_word(text.substr(0, end))) {
      return false;
    }
  }
  return true;
}

}  // namespace

void read_io_csv(Attributes& attributes, const std::filesystem::path& folder, IoCsv& csv) {
  if (const auto file = attributes.need("file", "file=\"recorded.csv\"")) {
    csv.file = (folder / *file).lexically_normal();
    csv.as_written = *file;
  }
  csv.loop = attributes.choose("end", {"hold", "loop"}).value_or(0) == 1;
}

void read_io_fmu(Attributes& attributes, const std::filesystem::path& folder, IoFmu& fmu) {
  if (const auto file = attributes.need("file", "file=\"press.fmu\"", &fmu.file_place)) {
    fmu.file = (folder / *file).lexically_normal();
    fmu.as_written = *file;
  }
  if (const auto space = attributes.text("variables", &fmu.variables_place)) {
    fmu.variables = *space;
    if (!is_namespace(*space)) {
      attributes.report().error(
          fmu.variables_place,
          fmt::format("variables: {} is no namespace; write press or cell::press", base::in_quotes(*space)));
      fmu.variables.clear();
    }
  }
  fmu.log = attributes.choose("log", {"off", "on"}).value_or(0) == 1;
}

void read_io_start(const base::Element& element, IoFmu& fmu, base::Diagnostics& report) {
  Attributes attributes(element, report);
  IoFmuStart start;
  start.at = attributes.need("at", "at=\"cylinder.mass\"", &start.at_place).value_or("");
  const auto value = attributes.need("value", "value=\"120\"", &start.value_place);
  start.value = value.value_or("");
  if (is_leaf(element, report)) {
    check_no_text(element, report);
  }
  attributes.finish("<set> of an fmu device");
  const auto first = std::find_if(fmu.starts.begin(), fmu.starts.end(),
                                  [&start](const IoFmuStart& other) { return other.at == start.at; });
  if (first != fmu.starts.end() && !start.at.empty()) {
    report.error(start.at_place, fmt::format("{} is set in line {} already; remove one", base::in_quotes(start.at),
                                             first->at_place.line));
  }
  if (!start.at.empty() && value) {
    fmu.starts.push_back(std::move(start));
  }
}

}  // namespace indurop::config

// SPDX-License-Identifier: Apache-2.0
#include "control/plc/openplc/read_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "control/plc/openplc/drawing.h"
#include "core/base/json.h"

namespace indurop::plc::openplc {
namespace {

using base::Json;
using Language = network::Body::Language;

// Returns ARRAY [0..9] OF INT.
std::string array_text(const Json& dimensions, const Json& element) {
  std::string bounds;
  for (const Json& one : dimensions.values()) {
    bounds += (bounds.empty() ? "" : ", ") + text_of(one["dimension"]);
  }
  return fmt::format("ARRAY [{}] OF {}", bounds, text_of(element["value"]));
}

std::string type_text(const Json& type) {
  return text_of(type["definition"]) == "array" ? array_text(type["data"]["dimensions"], type["data"]["baseType"])
                                                : text_of(type["value"]);
}

// Returns "speed AT %QW0 : INT := 5;".
std::string variable_text(const Json& variable) {
  const std::string place = text_of(variable["location"]);
  const Json& initial = variable["initialValue"];
  const std::string value = initial.is_object() ? text_of(initial["simpleValue"]["value"]) : text_of(initial);
  return fmt::format("{}{}{} : {}{}{};", text_of(variable["name"]), place.empty() ? "" : " AT ", place,
                     type_text(variable["type"]), value.empty() ? "" : " := ", value);
}

std::string data_type_text(const Json& type) {
  const std::string kind = text_of(type["derivation"]);
  const std::string initial = text_of(type["initialValue"]);
  const std::string end = initial.empty() ? "" : " := " + initial;
  std::string inside;
  if (kind == "structure") {
    for (const Json& field : type["variable"].values()) {
      inside += " " + variable_text(field);
    }
    return fmt::format("{} : STRUCT{} END_STRUCT;", text_of(type["name"]), inside);
  }
  if (kind == "enumerated") {
    for (const Json& value : type["values"].values()) {
      inside += (inside.empty() ? "" : ", ") + text_of(value["description"]);
    }
    return fmt::format("{} : ({}){};", text_of(type["name"]), inside, end);
  }
  return fmt::format("{} : {}{};", text_of(type["name"]), array_text(type["dimensions"], type["baseType"]), end);
}

const char* section_of(const std::string& kind) {
  if (kind == "input") {
    return "VAR_INPUT";
  }
  if (kind == "output") {
    return "VAR_OUTPUT";
  }
  if (kind == "inOut") {
    return "VAR_IN_OUT";
  }
  if (kind == "external") {
    return "VAR_EXTERNAL";
  }
  if (kind == "temp") {
    return "VAR_TEMP";
  }
  return "VAR";
}

std::string word_of(const std::string& kind) {
  return kind == "function" ? "FUNCTION" : kind == "function-block" ? "FUNCTION_BLOCK" : "PROGRAM";
}

class ProjectReader {
 public:
  ProjectReader(std::string_view text, Place at, TextReader reader, std::vector<st::WrittenBody>& others,
                Diagnostics& diagnostics)
      : text_(text), at_(std::move(at)), read_(reader), others_(others), diagnostics_(diagnostics) {}

  Project read(const Json& project) {
    const Json& data = project["data"];
    for (const Json& type : data["dataTypes"].values()) {
      parse("TYPE " + data_type_text(type) + " END_TYPE", place_of(type));
    }
    for (const Json& pou : data["pous"].values()) {
      this->pou(text_of(pou["type"]), pou["data"]);
    }
    resource(data["configuration"]["resource"]);
    return std::move(out_);
  }

 private:
  // Returns the line that contains its name.
  Place place_of(const Json& named) const {
    Place at = at_;
    at.column = 0;
    const std::size_t found = text_.find(fmt::format("\"{}\"", text_of(named["name"])));
    at.line =
        found == std::string_view::npos
            ? 1
            : 1 + static_cast<int>(std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(found), '\n'));
    return at;
  }

  void parse(const std::string& text, const Place& at) {
    std::vector<st::WrittenBody> bodies;
    Project made = read_({text, at}, bodies, diagnostics_);
    for (st::WrittenBody& body : bodies) {
      body.pou += out_.pous.size();
      others_.push_back(std::move(body));
    }
    append(out_, std::move(made));
  }

  // Reads a POU of a project that stores its POUs in project.json.
  void pou(const std::string& kind, const Json& data) {
    const std::string word = word_of(kind);
    const std::string result = kind == "function" ? " : " + text_of(data["returnType"]) : "";
    std::string text = fmt::format("{} {}{}", word, text_of(data["name"]), result);
    for (const Json& variable : data["variables"].values()) {
      text += fmt::format(" {} {} END_VAR", section_of(text_of(variable["class"])), variable_text(variable));
    }
    const Json& body = data["body"];
    const std::string language = text_of(body["language"]);
    const Place at = place_of(data);
    if (language == "ld" || language == "fbd") {
      const std::size_t before = out_.pous.size();
      parse(text + " END_" + word, at);
      if (out_.pous.size() > before) {
        st::WrittenBody drawn;
        drawn.pou = before;
        drawn.code.body =
            read_drawing(body["value"], language == "ld" ? Language::Ld : Language::Fbd, at, text_of(data["name"]));
        others_.push_back(std::move(drawn));
      }
    } else if (language == "st" || language == "il") {
      parse(fmt::format("{}\n{}\nEND_{}", text, text_of(body["value"]), word), at);
    } else {
      diagnostics_.error(at, fmt::format("{} is in {}, which is not supported, write it in ST, IL, LD or FBD",
                                         text_of(data["name"]), language));
    }
  }

  void resource(const Json& data) {
    Resource made;
    made.at = at_;
    for (const Json& variable : data["globalVariables"].values()) {
      const std::string constant = text_of(variable["class"]) == "constant" ? "CONSTANT " : "";
      parse(fmt::format("VAR_GLOBAL {}{} END_VAR", constant, variable_text(variable)), place_of(variable));
    }
    for (const Json& task : data["tasks"].values()) {
      Task one;
      one.at = place_of(task);
      one.name = text_of(task["name"]);
      const auto interval = st::parse_expression({text_of(task["interval"]), one.at}, diagnostics_);
      const auto* ns = interval ? std::get_if<std::int64_t>(&interval->value) : nullptr;
      if (ns == nullptr) {
        diagnostics_.error(one.at, fmt::format("the task {} has no interval, give it one such as T#20ms", one.name));
        continue;
      }
      one.interval_ns = *ns;
      one.priority = static_cast<std::int32_t>(task["priority"].integer().value_or(0));
      made.tasks.push_back(std::move(one));
    }
    for (const Json& one : data["instances"].values()) {
      made.programs.push_back({place_of(one), text_of(one["name"]), text_of(one["task"]), text_of(one["program"])});
    }
    if (!made.tasks.empty() || !made.programs.empty()) {
      Configuration& configuration = out_.configurations.emplace_back();
      configuration.at = at_;
      configuration.resources.push_back(std::move(made));
    }
  }

  std::string_view text_;
  Place at_;
  TextReader read_;
  std::vector<st::WrittenBody>& others_;
  Diagnostics& diagnostics_;
  Project out_;
};

}  // namespace

Project read_project(std::string_view json, const Place& at, TextReader read, std::vector<st::WrittenBody>& others,
                     Diagnostics& diagnostics) {
  const auto project = Json::parse(json);
  if (!project || !(*project)["data"].is_object()) {
    diagnostics.error(at, "this is no project of the OpenPLC Editor, which has \"meta\" and \"data\"");
    return {};
  }
  return ProjectReader(json, at, read, others, diagnostics).read(*project);
}

Project read_drawn(std::string_view text, const Place& at, Language language, std::vector<st::WrittenBody>& others,
                   Diagnostics& diagnostics) {
  const std::size_t begin = text.starts_with('{') ? 0 : std::min(text.find("\n{"), text.size());
  const std::size_t end = text.rfind('}');
  const auto flow = begin < text.size() && end != std::string_view::npos && end > begin
                        ? Json::parse(text.substr(begin, end + 1 - begin))
                        : std::nullopt;
  if (!flow) {
    diagnostics.error(at, "there is no drawing in it as the OpenPLC Editor writes it, between END_VAR and the end");
    return {};
  }
  std::string declarations(text);
  std::replace_if(
      declarations.begin() + static_cast<std::ptrdiff_t>(begin),
      declarations.begin() + static_cast<std::ptrdiff_t>(end) + 1, [](char one) { return one != '\n'; }, ' ');
  Project out = st::parse_project({declarations, at}, others, diagnostics);
  if (out.pous.size() == 1) {
    Place where = at;
    where.line +=
        static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n')) + 1;
    st::WrittenBody drawn;
    drawn.code.body = read_drawing(*flow, language, where, out.pous[0].name);
    others.push_back(std::move(drawn));
  }
  return out;
}

}  // namespace indurop::plc::openplc

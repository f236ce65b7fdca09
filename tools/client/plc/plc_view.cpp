// SPDX-License-Identifier: Apache-2.0
#include "tools/client/plc/plc_view.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <set>
#include <sstream>

#include "control/plc/draw/shape.h"
#include "control/plc/draw/text_picture.h"
#include "control/plc/print/chart_text.h"
#include "control/plc/print/live_text.h"
#include "control/plc/print/print.h"
#include "control/plc/print/value_text.h"
#include "core/schema/schema.h"
#include "tools/client/plc/plc_path.h"
#include "tools/client/process/gentle.h"
#include "tools/client/text/units.h"

namespace indurop::tools {
namespace {

// Returns the texts that may contain names of shared variables.
std::vector<std::string> texts_of(const plc::LiveBody& body) {
  if (is_text(body)) {
    return {body.body->text};
  }
  std::vector<std::string> texts;
  for (const plc::draw::Picture& picture : body.pictures) {
    for (const plc::draw::Symbol& symbol : picture.symbols) {
      if (symbol.element != nullptr && symbol.element->kind == plc::network::Element::Kind::InVariable) {
        texts.push_back(symbol.element->text);
      }
    }
  }
  if (body.chart) {
    for (const plc::network::Transition& one : body.chart->transitions) {
      texts.push_back(plc::condition_text(*one.element));
    }
  }
  return texts;
}

}  // namespace

bool is_text(const plc::LiveBody& body) {
  return body.body->language == plc::network::Body::Language::St ||
         body.body->language == plc::network::Body::Language::Il;
}

std::string first_indent(const plc::LiveBody& body) {
  std::string blanks(static_cast<std::size_t>(std::max(1, body.body->text_at.column) - 1), ' ');
  return blanks;
}

PlcView::PlcView(Access& access, const plc::WatchPlan& plan, std::vector<plc::LiveBody> bodies, ViewChoice choice)
    : access_(access), plan_(plan), bodies_(std::move(bodies)), choice_(std::move(choice)) {}

Result<void, Failure> PlcView::open() {
  if (auto chosen = choose(); !chosen) {
    return chosen;
  }
  for (const plc::WatchLayout& layout : plan_.layouts) {
    auto& paths = paths_.emplace_back();
    for (const plc::WatchedVariable& one : layout.variables) {
      paths.emplace(one.path, &one);
    }
  }
  source_.emplace(access_.node, names());
  if (auto opened = source_->open(access_); !opened) {
    if (!opened.error().text.empty()) {
      access_.messages->error(opened.error().text);
    }
    access_.messages->note("was the module built with `indurop plc build --watch`?");
    return Failure{opened.error().code, {}};
  }
  be_gentle(source_->node());
  return sample();
}

Result<void, Failure> PlcView::sample() {
  source_->sample(access_, 0, SIZE_MAX);
  return check_marks();
}

// Chooses the programs, or one instance of the selected POU.
Result<void, Failure> PlcView::choose() {
  for (std::size_t i = 0; i < plan_.layouts.size(); ++i) {
    for (const plc::WatchedInstance& one : plan_.layouts[i].instances) {
      const std::string full = title_of(i, one.name);
      const bool named = choice_.instance.empty()
                             ? (choice_.pou.empty() ? one.path.empty() : plc::same_name(one.pou->name, choice_.pou))
                             : plc::same_name(full, choice_.instance);
      if (named && !one.path.empty() && choice_.instance.empty() && !shown_.empty()) {
        others_ += (others_.empty() ? "" : ", ") + full;
      } else if (named) {
        show(i, one);
      }
    }
  }
  if (!shown_.empty()) {
    return {};
  }
  if (choice_.instance.empty() && choice_.pou.empty()) {
    return Failure{kFailed, "there is no program to show; code in files of TwinCAT is not shown"};
  }
  return Failure{kFailed,
                 choice_.instance.empty()
                     ? fmt::format("there is no instance of '{}' with code to show", choice_.pou)
                     : fmt::format("there is no instance '{}'; write main.motor for motor in main", choice_.instance)};
}

// A program has its own name, unless it runs several times.
std::string PlcView::title_of(std::size_t program, const std::string& name) const {
  const plc::TaskProgram& one = *plan_.instances[program];
  const auto alike = std::count_if(plan_.instances.begin(), plan_.instances.end(),
                                   [&](const plc::TaskProgram* each) { return each->pou == one.pou; });
  return (alike == 1 ? one.pou->name : one.instance) + (name.empty() ? "" : "." + name);
}

void PlcView::show(std::size_t program, const plc::WatchedInstance& instance) {
  const std::string title = title_of(program, instance.name);
  for (const plc::LiveBody& body : bodies_) {
    if (plc::same_name(body.pou, instance.pou->name)) {
      shown_.push_back({&body, title, instance.path, program});
    }
  }
}

// Returns the names of the programs' watched data, and of the shared variables in their texts.
std::vector<std::string> PlcView::names() {
  const std::string space = plan_.space + "::";
  std::vector<std::string> names;
  values_of_.resize(plan_.layouts.size());
  for (std::size_t i = 0; i < plan_.layouts.size(); ++i) {
    values_of_[i] = names.size();
    names.push_back(space + plan_.layouts[i].variable);
  }
  for (const Shown& shown : shown_) {
    for (const std::string& text : texts_of(*shown.body)) {
      for (const std::string& path : plc::paths_in(text)) {
        add_shared(path, names);
      }
    }
  }
  return names;
}

// For "LIST[2].X" of a global: adds its name in the store, if it is a shared variable.
void PlcView::add_shared(const std::string& path, std::vector<std::string>& names) {
  const std::size_t end = std::min(path.find_first_of(".["), path.size());
  const auto global = plan_.program->global_names.find(path.substr(0, end));
  if (shared_.contains(path) || global == plan_.program->global_names.end() || global->second->shared_name.empty()) {
    return;
  }
  if (const auto part = part_of(*global->second->type, std::string_view(path).substr(end))) {
    shared_[path] = names.size();
    types_[path] = part->type;
    names.push_back(global->second->shared_name + part->place);
  }
}

Result<void, Failure> PlcView::check_marks() const {
  for (std::size_t i = 0; i < plan_.layouts.size(); ++i) {
    const auto& bytes = source_->values()[values_of_[i]].bytes;
    std::uint64_t mark = 0;
    if (bytes.size() == plan_.layouts[i].bytes) {
      std::memcpy(&mark, bytes.data(), sizeof mark);
    }
    if (bytes.size() != plan_.layouts[i].bytes || (mark != 0 && mark != plan_.layouts[i].mark)) {
      return Failure{kSchemaMismatch,
                     "the program that runs is not the one in these files; build it again and restart the node"};
    }
  }
  return {};
}

std::string PlcView::path_of(const Shown& shown, const std::string& path) const {
  return shown.inside.empty() ? path : shown.inside + "." + path;
}

std::span<const std::uint8_t> PlcView::bytes_of(const Shown& shown) const {
  return source_->values()[values_of_[shown.program]].bytes;
}

const plc::WatchedVariable* PlcView::find(const Shown& shown, const std::string& path) const {
  const auto& paths = paths_[shown.program];
  const auto found = paths.find(path_of(shown, path));
  return found == paths.end() ? nullptr : found->second;
}

bool PlcView::flag(const Shown& shown, const std::string& path, std::size_t index) const {
  const plc::WatchedVariable* found = find(shown, path);
  const auto bytes = bytes_of(shown);
  return found != nullptr && found->offset + index < bytes.size() && bytes[found->offset + index] != 0;
}

std::string PlcView::value(const Shown& shown, const std::string& path) const {
  const auto bytes = bytes_of(shown);
  for (std::size_t end = path.size(); end != std::string::npos && end > 0; end = path.find_last_of(".[", end - 1)) {
    if (const plc::WatchedVariable* found = find(shown, path.substr(0, end))) {
      const auto part = part_of(*found->type, std::string_view(path).substr(end));
      return part && found->offset + part->offset <= bytes.size()
                 ? plc::value_text(*part->type, bytes.subspan(found->offset + part->offset))
                 : std::string();
    }
  }
  return shared_value(path);
}

std::string PlcView::shared_value(const std::string& name) const {
  const auto found = shared_.find(name);
  if (found == shared_.end()) {
    return {};
  }
  const WatchedValue& value = source_->values()[found->second];
  const plc::Type& type = *types_.at(name);
  const bool plain = type.kind == plc::Type::Kind::Elementary && plc::packed_size(type) == value.bytes.size();
  return plain ? plc::value_text(type, value.bytes)
               : printable(schema::format_value(value.item.place.type, value.bytes));
}

std::string PlcView::output_value(const Shown& shown, const plc::network::Source& source) const {
  if (source.element->instance.empty() || source.pin == nullptr) {
    return {};
  }
  const plc::WatchedVariable* found = find(shown, plc::upper(source.element->instance + "." + source.pin->name));
  const bool flows = found == nullptr || found->type->is(plc::Elementary::Bool);
  return flows ? std::string() : plc::value_text(*found->type, bytes_of(shown).subspan(found->offset));
}

plc::draw::Live PlcView::live_of(const Shown& shown) const {
  const auto power = std::make_shared<plc::LivePower>(
      *shown.body,
      [this, &shown, flow = plc::upper(shown.body->flow_variable)](std::size_t number) {
        return flag(shown, flow, number);
      },
      [this, &shown](const std::string& name) { return value(shown, name); });
  plc::draw::Live live;
  live.powered = [power](const plc::network::Source& source) { return power->powered(source); };
  live.closed = [power](const plc::network::Element& element) { return power->closed(element); };
  live.value = [this, &shown](const plc::network::Source& source) { return output_value(shown, source); };
  return live;
}

}  // namespace indurop::tools

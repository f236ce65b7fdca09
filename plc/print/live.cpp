// SPDX-License-Identifier: Apache-2.0
#include "plc/print/live.h"

#include "plc/lower/flow.h"
#include "plc/print/print.h"

namespace indurop::plc {
namespace {

using Language = network::Body::Language;

void number_points(const lower::LoweredNetworks& lowered, LiveProgram& program) {
  std::size_t bit = 0;
  for (const lower::FlowPoint& point : lowered.flow) {
    switch (point.kind) {
      case lower::FlowPoint::Kind::Power:
        program.power.emplace(LiveProgram::Key(point.source.element, point.source.pin), bit++);
        break;
      case lower::FlowPoint::Kind::Closed:
        program.closed.emplace(point.source.element, bit++);
        break;
      case lower::FlowPoint::Kind::Value:
        program.values.push_back({point.source, lower::value_variable(program.pou, point.source), point.type});
        break;
    }
  }
  constexpr std::size_t kBits = 8;
  program.flow_bytes = (bit + kBits - 1) / kBits;
  program.flow_variable = bit == 0 ? std::string() : lower::flow_variable(program.pou);
}

}  // namespace

std::vector<LiveProgram> live_programs(plcopen::Document& document, const std::string& pou, Diagnostics& diagnostics) {
  Project declared;
  for (const plcopen::PouDocument& each : document.pous) {
    declared.pous.push_back(each.pou);
  }
  std::vector<LiveProgram> programs;
  for (plcopen::PouDocument& each : document.pous) {
    const bool drawn = each.code.body.language == Language::Ld || each.code.body.language == Language::Fbd;
    if (!drawn || each.pou.kind != ast::Pou::Kind::Program || (!pou.empty() && !same_name(pou, each.pou.name))) {
      continue;
    }
    LiveProgram program{each.pou.name,
                        {},
                        each.code.body.language,
                        network::make_sheet(each.code.body, "POU " + each.pou.name, diagnostics),
                        {},
                        {},
                        0,
                        {},
                        {},
                        {}};
    if (diagnostics.failed()) {
      continue;
    }
    lower::NetworkOptions options;
    options.project = &declared;
    options.flow = true;
    number_points(lower::lower_networks(program.sheet, options, diagnostics), program);
    program.pictures = draw::lay_out(program.sheet, program.language);
    programs.push_back(std::move(program));
  }
  return programs;
}

}  // namespace indurop::plc

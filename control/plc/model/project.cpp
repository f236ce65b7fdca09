// SPDX-License-Identifier: Apache-2.0
#include "control/plc/model/project.h"

#include <iterator>

namespace indurop::plc {
namespace {

template <class List>
void move_all(List& into, List& from) {
  into.insert(into.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

std::string why_left_out(const Project& project, const std::string& name) {
  for (const ast::NameAt& one : project.left_out) {
    if (same_name(one.name, name)) {
      return "; it was left out because of C code, see " + to_string(one.at) +
             "; write that in ST, or as a module of its own";
    }
  }
  return "";
}

void append(Project& into, Project from) {
  move_all(into.types, from.types);
  move_all(into.pous, from.pous);
  move_all(into.globals, from.globals);
  move_all(into.global_lists, from.global_lists);
  move_all(into.left_out, from.left_out);
  move_all(into.configured, from.configured);
  move_all(into.accesses, from.accesses);
  into.incomplete = into.incomplete || from.incomplete;
  into.dialect = from.dialect == Dialect::Iec ? into.dialect : from.dialect;
  move_all(into.configurations, from.configurations);
}

}  // namespace indurop::plc

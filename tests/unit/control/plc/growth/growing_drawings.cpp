// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/control/plc/growth/growing_drawings.h"

#include <string_view>

namespace indurop::plc::testing {
namespace {

using Size = std::size_t;

std::string number(Size n) {
  return std::to_string(n);
}

std::string drawing(const std::string& language, const std::string& inner) {
  return "<?xml version='1.0' encoding='utf-8'?>\n<project xmlns='http://www.plcopen.org/xml/tc6_0201'>"
         "<fileHeader companyName='x' productName='x' productVersion='1' creationDateTime='2024-01-01T00:00:00'/>"
         "<contentHeader name='x'><coordinateInfo><fbd><scaling x='1' y='1'/></fbd><ld><scaling x='1' y='1'/></ld><sfc>"
         "<scaling x='1' y='1'/></sfc></coordinateInfo></contentHeader><types><dataTypes/><pous><pou name='main' "
         "pouType='program'><interface><localVars><variable name='a'><type><BOOL/></type></variable><variable name='n'>"
         "<type><INT/></type></variable></localVars></interface><body><" +
         language + ">\n" + inner + "</" + language +
         "></body></pou></pous></types><instances><configurations/>"
         "</instances></project>\n";
}

std::string place(Size x, Size y) {
  return "<position x='" + number(x) + "' y='" + number(y) + "'/>";
}

std::string from(Size id, std::string_view parameter = "") {
  return "<connection refLocalId='" + number(id) + "'" +
         (parameter.empty() ? "" : " formalParameter='" + std::string(parameter) + "'") + "/>";
}

std::string in_from(Size id) {
  return "<connectionPointIn>" + from(id) + "</connectionPointIn>";
}

constexpr const char* kOut = "<connectionPointOut/>";

std::string rail() {
  return "<leftPowerRail localId='1' height='10' width='10'>" + place(0, 0) +
         "<connectionPointOut formalParameter=''/></leftPowerRail>\n";
}

std::string contact(Size id, Size before, Size y = 0) {
  return "<contact localId='" + number(id) + "' height='10' width='20'>" + place(id * 30, y) + in_from(before) + kOut +
         "<variable>a</variable></contact>\n";
}

std::string coil(Size id, const std::string& in, Size y = 0) {
  return "<coil localId='" + number(id) + "' height='10' width='20'>" + place(id * 30, y) + "<connectionPointIn>" + in +
         "</connectionPointIn>" + kOut + "<variable>a</variable></coil>\n";
}

std::string fbd_block(Size id, const std::string& type, const std::string& in1, const std::string& in2) {
  const auto pin = [](const char* name, const std::string& in) {
    return "<variable formalParameter='" + std::string(name) + "'><connectionPointIn>" + in +
           "</connectionPointIn></variable>";
  };
  return "<block localId='" + number(id) + "' height='40' width='40' typeName='" + type + "'>" + place(id * 60, 0) +
         "<inputVariables>" + pin("IN1", in1) + pin("IN2", in2) +
         "</inputVariables><inOutVariables/><outputVariables><variable formalParameter='OUT'>" + kOut +
         "</variable></outputVariables></block>\n";
}

std::string fbd_variable(Size id, std::string_view name) {
  return "<inVariable localId='" + number(id) + "' height='20' width='20'>" + place(0, id * 30) + kOut +
         "<expression>" + std::string(name) + "</expression></inVariable>\n";
}

std::string fbd_result(Size id, Size before) {
  return "<outVariable localId='" + number(id) + "' height='20' width='20'>" + place(id * 60, 0) +
         "<connectionPointIn>" + from(before, "OUT") + "</connectionPointIn><expression>n</expression></outVariable>\n";
}

}  // namespace

std::string rungs(Size n) {
  std::string out = rail();
  for (Size i = 0; i < n; ++i) {
    out += contact(2 * i + 2, 1, 40 * i) + coil(2 * i + 3, from(2 * i + 2), 40 * i);
  }
  return drawing("LD", out);
}

std::string contacts_in_series(Size n) {
  std::string out = rail();
  for (Size i = 0; i < n; ++i) {
    out += contact(i + 2, i + 1);
  }
  return drawing("LD", out + coil(n + 2, from(n + 1)));
}

std::string contacts_in_parallel(Size n) {
  std::string out = rail();
  std::string in;
  for (Size i = 0; i < n; ++i) {
    out += contact(i + 2, 1, 40 * i);
    in += from(i + 2);
  }
  return drawing("LD", out + coil(n + 2, in));
}

std::string contacts_crosswise(Size n) {
  std::string out = rail();
  for (Size i = 0; i < n; ++i) {
    for (const Size k : {2 * i + 2, 2 * i + 3}) {
      const std::string in = i == 0 ? from(1) : from(2 * i) + from(2 * i + 1);
      out += "<contact localId='" + number(k) + "' height='10' width='20'>" + place(i * 60, 40 * (k % 2)) +
             "<connectionPointIn>" + in + "</connectionPointIn>" + kOut + "<variable>a</variable></contact>\n";
    }
  }
  return drawing("LD", out + coil(2 * n + 2, from(2 * n) + from(2 * n + 1)));
}

std::string blocks_in_series(Size n) {
  std::string out = fbd_variable(1, "n");
  for (Size i = 0; i < n; ++i) {
    out += fbd_block(i + 2, "ADD", i == 0 ? from(1) : from(i + 1, "OUT"), from(1));
  }
  return drawing("FBD", out + fbd_result(n + 2, n + 1));
}

std::string blocks_doubled(Size n) {
  std::string out = fbd_variable(1, "n");
  for (Size i = 0; i < n; ++i) {
    const std::string in = i == 0 ? from(1) : from(i + 1, "OUT");
    out += fbd_block(i + 2, "ADD", in, in);
  }
  return drawing("FBD", out + fbd_result(n + 2, n + 1));
}

std::string blocks_far_apart(Size n) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    out += fbd_variable(i + 1, "n");
  }
  for (Size i = 0; i < 2 * n; ++i) {
    out += fbd_block(n + i + 1, "ADD", i == 0 ? from(1) : from(n + i, "OUT"), from(i % n + 1));
  }
  return drawing("FBD", out + fbd_result(3 * n + 1, 3 * n));
}

std::string rungs_wide(Size n) {
  std::string out = rail();
  for (Size i = 0; i < n; ++i) {
    out += contact(i + 2, i + 1) + contact(n + 2 * i + 3, 1, 40 * (i + 1)) +
           coil(n + 2 * i + 4, from(n + 2 * i + 3), 40 * (i + 1));
  }
  return drawing("LD", out + coil(n + 2, from(n + 1)));
}

std::string networks(Size n) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    out += fbd_variable(2 * i + 1, "n") + "<outVariable localId='" + number(2 * i + 2) + "' height='20' width='20'>" +
           place(60, (2 * i + 1) * 30) + in_from(2 * i + 1) + "<expression>n</expression></outVariable>\n";
  }
  return drawing("FBD", out);
}

std::string connectors(Size n) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    out += fbd_variable(3 * i + 1, "n") + "<connector localId='" + number(3 * i + 2) +
           "' height='20' width='20' name='c" + number(i) + "'>" + place(60, 60 * i) + in_from(3 * i + 1) +
           "</connector>\n<continuation localId='" + number(3 * i + 3) + "' height='20' width='20' name='c" +
           number(i) + "'>" + place(90, 60 * i) + kOut + "</continuation>\n";
  }
  return drawing("FBD", out);
}

}  // namespace indurop::plc::testing

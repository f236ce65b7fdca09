// SPDX-License-Identifier: Apache-2.0
#include "control/plc/library/standard.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "control/plc/library/conversions.h"
#include "control/plc/library/signature.h"

namespace indurop::plc {
namespace {

struct Row {
  std::string_view signature;
  std::string_view cpp;  // without iec::; '!' in front: may fault; '+': joins texts
};

constexpr Row kFunctions[] = {
    {"ABS(IN ANY_NUM): ANY_NUM", "abs"},
    {"SQRT(IN ANY_REAL): ANY_REAL", "sqrt"},
    {"LN(IN ANY_REAL): ANY_REAL", "ln"},
    {"LOG(IN ANY_REAL): ANY_REAL", "log"},
    {"EXP(IN ANY_REAL): ANY_REAL", "exp"},
    {"SIN(IN ANY_REAL): ANY_REAL", "sin"},
    {"COS(IN ANY_REAL): ANY_REAL", "cos"},
    {"TAN(IN ANY_REAL): ANY_REAL", "tan"},
    {"ASIN(IN ANY_REAL): ANY_REAL", "asin"},
    {"ACOS(IN ANY_REAL): ANY_REAL", "acos"},
    {"ATAN(IN ANY_REAL): ANY_REAL", "atan"},
    {"ATAN2(Y ANY_REAL, X ANY_REAL): ANY_REAL", "atan2"},
    {"IS_VALID(IN ANY_REAL): BOOL", "is_valid"},
    {"IS_VALID_BCD(IN ANY_BIT): BOOL", "is_valid_bcd"},
    {"TO_BIG_ENDIAN(IN ANY_ELEMENTARY): ANY_ELEMENTARY", "big_endian"},
    {"TO_LITTLE_ENDIAN(IN ANY_ELEMENTARY): ANY_ELEMENTARY", "little_endian"},
    {"FROM_BIG_ENDIAN(IN ANY_ELEMENTARY): ANY_ELEMENTARY", "big_endian"},
    {"FROM_LITTLE_ENDIAN(IN ANY_ELEMENTARY): ANY_ELEMENTARY", "little_endian"},
    {"ADD(IN1 ANY_NUM, IN2 ANY_NUM...): ANY_NUM", "add"},
    {"ADD(IN1 TIME, IN2 TIME): TIME", "add"},
    {"ADD(IN1 TOD, IN2 TIME): TOD", "add"},
    {"ADD(IN1 DT, IN2 TIME): DT", "add"},
    {"MUL(IN1 ANY_NUM, IN2 ANY_NUM...): ANY_NUM", "mul"},
    {"MUL(IN1 TIME, IN2 ANY_NUM): TIME", "mul"},
    {"SUB(IN1 ANY_NUM, IN2 ANY_NUM): ANY_NUM", "sub"},
    {"SUB(IN1 TIME, IN2 TIME): TIME", "sub"},
    {"SUB(IN1 DATE, IN2 DATE): TIME", "sub"},
    {"SUB(IN1 TOD, IN2 TIME): TOD", "sub"},
    {"SUB(IN1 TOD, IN2 TOD): TIME", "sub"},
    {"SUB(IN1 DT, IN2 TIME): DT", "sub"},
    {"SUB(IN1 DT, IN2 DT): TIME", "sub"},
    {"DIV(IN1 ANY_NUM, IN2 ANY_NUM): ANY_NUM", "!div"},
    {"DIV(IN1 TIME, IN2 ANY_NUM): TIME", "!div"},
    {"MOD(IN1 ANY_INT, IN2 ANY_INT): ANY_INT", "!mod"},
    {"EXPT(IN1 ANY_REAL, IN2 ANY_NUM): ANY_REAL", "expt"},
    {"MOVE(IN ANY): ANY", "move"},

    {"SHL(IN ANY_BIT, N ANY_INT): ANY_BIT", "shl"},
    {"SHR(IN ANY_BIT, N ANY_INT): ANY_BIT", "shr"},
    {"ROL(IN ANY_BIT, N ANY_INT): ANY_BIT", "rol"},
    {"ROR(IN ANY_BIT, N ANY_INT): ANY_BIT", "ror"},
    {"AND(IN1 ANY_BIT, IN2 ANY_BIT...): ANY_BIT", "bit_and"},
    {"OR(IN1 ANY_BIT, IN2 ANY_BIT...): ANY_BIT", "bit_or"},
    {"XOR(IN1 ANY_BIT, IN2 ANY_BIT...): ANY_BIT", "bit_xor"},
    {"NOT(IN ANY_BIT): ANY_BIT", "bit_not"},

    {"SEL(G BOOL, IN0 ANY, IN1 ANY): ANY", "sel"},
    {"MUX(K ANY_INT, IN0 ANY, IN1 ANY...): ANY", "!mux"},
    {"MAX(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): ANY_ELEMENTARY", "max"},
    {"MIN(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): ANY_ELEMENTARY", "min"},
    {"LIMIT(MN ANY_ELEMENTARY, IN ANY_ELEMENTARY, MX ANY_ELEMENTARY): ANY_ELEMENTARY", "limit"},

    {"GT(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): BOOL", "gt"},
    {"GE(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): BOOL", "ge"},
    {"EQ(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): BOOL", "eq"},
    {"LE(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): BOOL", "le"},
    {"LT(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY...): BOOL", "lt"},
    {"NE(IN1 ANY_ELEMENTARY, IN2 ANY_ELEMENTARY): BOOL", "ne"},

    {"LEN(IN/STR STRING): INT", "len"},
    {"LEN(IN/STR WSTRING): INT", "len"},
    {"LEFT(IN/STR STRING, L/SIZE ANY_INT): STRING", "left"},
    {"LEFT(IN/STR WSTRING, L/SIZE ANY_INT): WSTRING", "left"},
    {"RIGHT(IN/STR STRING, L/SIZE ANY_INT): STRING", "right"},
    {"RIGHT(IN/STR WSTRING, L/SIZE ANY_INT): WSTRING", "right"},
    {"MID(IN/STR STRING, L/LEN ANY_INT, P/POS ANY_INT): STRING", "mid"},
    {"MID(IN/STR WSTRING, L/LEN ANY_INT, P/POS ANY_INT): WSTRING", "mid"},
    {"CONCAT(IN1/STR1 STRING, IN2/STR2 STRING...): STRING", "+concat"},
    {"CONCAT(IN1/STR1 WSTRING, IN2/STR2 WSTRING...): WSTRING", "+concat"},
    {"INSERT(IN1/STR1 STRING, IN2/STR2 STRING, P/POS ANY_INT): STRING", "+insert"},
    {"INSERT(IN1/STR1 WSTRING, IN2/STR2 WSTRING, P/POS ANY_INT): WSTRING", "+insert"},
    {"DELETE(IN/STR STRING, L/LEN ANY_INT, P/POS ANY_INT): STRING", "erase"},
    {"DELETE(IN/STR WSTRING, L/LEN ANY_INT, P/POS ANY_INT): WSTRING", "erase"},
    {"REPLACE(IN1/STR1 STRING, IN2/STR2 STRING, L ANY_INT, P ANY_INT): STRING", "+replace"},
    {"REPLACE(IN1/STR1 WSTRING, IN2/STR2 WSTRING, L ANY_INT, P ANY_INT): WSTRING", "+replace"},
    {"FIND(IN1/STR1 STRING, IN2/STR2 STRING): INT", "find"},
    {"FIND(IN1/STR1 WSTRING, IN2/STR2 WSTRING): INT", "find"},

    // As in the library Standard64 of CODESYS.
    {"WLEN(IN/STR WSTRING): INT", "len"},
    {"WLEFT(IN/STR WSTRING, L/SIZE ANY_INT): WSTRING", "left"},
    {"WRIGHT(IN/STR WSTRING, L/SIZE ANY_INT): WSTRING", "right"},
    {"WMID(IN/STR WSTRING, L/LEN ANY_INT, P/POS ANY_INT): WSTRING", "mid"},
    {"WCONCAT(IN1/STR1 WSTRING, IN2/STR2 WSTRING...): WSTRING", "+concat"},
    {"WINSERT(IN1/STR1 WSTRING, IN2/STR2 WSTRING, P/POS ANY_INT): WSTRING", "+insert"},
    {"WDELETE(IN/STR WSTRING, L/LEN ANY_INT, P/POS ANY_INT): WSTRING", "erase"},
    {"WREPLACE(IN1/STR1 WSTRING, IN2/STR2 WSTRING, L ANY_INT, P ANY_INT): WSTRING", "+replace"},
    {"WFIND(IN1/STR1 WSTRING, IN2/STR2 WSTRING): INT", "find"},

    {"ADD_TIME(IN1 TIME, IN2 TIME): TIME", "add"},
    {"ADD_TOD_TIME(IN1 TOD, IN2 TIME): TOD", "add"},
    {"ADD_DT_TIME(IN1 DT, IN2 TIME): DT", "add"},
    {"SUB_TIME(IN1 TIME, IN2 TIME): TIME", "sub"},
    {"SUB_DATE_DATE(IN1 DATE, IN2 DATE): TIME", "sub"},
    {"SUB_TOD_TIME(IN1 TOD, IN2 TIME): TOD", "sub"},
    {"SUB_TOD_TOD(IN1 TOD, IN2 TOD): TIME", "sub"},
    {"SUB_DT_TIME(IN1 DT, IN2 TIME): DT", "sub"},
    {"SUB_DT_DT(IN1 DT, IN2 DT): TIME", "sub"},
    {"MULTIME(IN1 TIME, IN2 ANY_NUM): TIME", "mul"},
    {"MUL_TIME(IN1 TIME, IN2 ANY_NUM): TIME", "mul"},
    {"DIVTIME(IN1 TIME, IN2 ANY_NUM): TIME", "!div"},
    {"DIV_TIME(IN1 TIME, IN2 ANY_NUM): TIME", "!div"},
    {"CONCAT_DATE_TOD(IN1 DATE, IN2 TOD): DT", "concat_date_tod"},
    {"CONCAT_DATE(YEAR INT, MONTH INT, DAY INT): DATE", "concat_date"},
    {"CONCAT_TOD(HOUR INT, MINUTE INT, SECOND INT, MILLISECOND INT): TOD", "concat_tod"},
    {"CONCAT_DT(YEAR INT, MONTH INT, DAY INT, HOUR INT, MINUTE INT, SECOND INT, MILLISECOND INT): DT", "concat_dt"},
    {"DAY_OF_WEEK(IN DATE): INT", "day_of_week"},
    {"TIME(): TIME", "time"},
    {"LTIME(): TIME", "time"},
    {"T_PLC_MS(): DWORD", "t_plc_ms"},
    {"T_PLC_US(): DWORD", "t_plc_us"},
};

constexpr Row kBlocks[] = {
    {"SR(S1/SET1 BOOL, R/RESET BOOL): Q1 BOOL", "Sr"},
    {"RS(S/SET BOOL, R1/RESET1 BOOL): Q1 BOOL", "Rs"},
    {"SEMA(CLAIM BOOL, RELEASE BOOL): BUSY BOOL", "Sema"},
    {"R_TRIG(CLK BOOL): Q BOOL", "RTrig"},
    {"F_TRIG(CLK BOOL): Q BOOL", "FTrig"},
    {"TP(IN BOOL, PT TIME): Q BOOL, ET TIME", "Tp"},
    {"TON(IN BOOL, PT TIME): Q BOOL, ET TIME", "Ton"},
    {"TOF(IN BOOL, PT TIME): Q BOOL, ET TIME", "Tof"},
    {"BLINK(ENABLE BOOL, TIMELOW TIME, TIMEHIGH TIME): OUT BOOL", "Blink"},
    {"RTC(IN/EN BOOL, PDT DT): Q BOOL, CDT DT", "Rtc"},
    {"HYSTERESIS(XIN1 REAL, XIN2 REAL, EPS REAL): Q BOOL", "Hysteresis"},
    {"INTEGRAL(RUN BOOL, R1 BOOL, XIN REAL, X0 REAL, CYCLE TIME): Q BOOL, XOUT REAL", "Integral"},
    {"DERIVATIVE(RUN BOOL, XIN REAL, CYCLE TIME): XOUT REAL", "Derivative"},
    {"PID(AUTO BOOL, PV REAL, SP REAL, X0 REAL, KP REAL, TR REAL, TD REAL, CYCLE TIME): XOUT REAL", "Pid"},
    {"RAMP(RUN BOOL, X0 REAL, X1 REAL, TR TIME, CYCLE TIME): BUSY BOOL, XOUT REAL", "Ramp"},
};

// '*' is replaced by the type of the counter: CTU counts an INT, CTU_DINT a DINT.
constexpr Row kCounters[] = {
    {"CTU(CU BOOL, R/RESET BOOL, PV *): Q BOOL, CV *", "Ctu"},
    {"CTD(CD BOOL, LD/LOAD BOOL, PV *): Q BOOL, CV *", "Ctd"},
    {"CTUD(CU BOOL, CD BOOL, R/RESET BOOL, LD/LOAD BOOL, PV *): QU BOOL, QD BOOL, CV *", "Ctud"},
};
constexpr Elementary kCounted[] = {Elementary::Int,  Elementary::Dint,  Elementary::Lint,
                                   Elementary::Uint, Elementary::Udint, Elementary::Ulint};

constexpr std::array<std::string_view, 6> kGenerics{"ANY",     "ANY_ELEMENTARY", "ANY_NUM",
                                                    "ANY_INT", "ANY_REAL",       "ANY_BIT"};

std::vector<LibraryFunction> make_functions() {
  std::vector<LibraryFunction> all;
  for (const Row& row : kFunctions) {
    all.push_back(make_function(row.signature, row.cpp));
  }
  append_conversions(all);
  return all;
}

std::vector<LibraryBlock> make_blocks() {
  std::vector<LibraryBlock> all;
  for (const Row& row : kBlocks) {
    all.push_back(make_block(row.signature, row.cpp));
  }
  for (const Row& row : kCounters) {
    std::string signature(row.signature);
    const std::string name = signature.substr(0, signature.find('('));
    for (const Elementary type : kCounted) {
      std::string typed;
      for (const char c : signature) {
        typed += c == '*' ? std::string(name_of(type)) : std::string(1, c);
      }
      LibraryBlock block = make_block(typed, std::string(row.cpp) + "<" + std::string(cpp_type(type)) + ">");
      if (type == Elementary::Int) {
        all.push_back(block);
      }
      block.name = name + "_" + std::string(name_of(type));
      all.push_back(block);
    }
  }
  return all;
}

bool named(const LibraryParameter& parameter, std::string_view name) {
  return same_name(parameter.name, name) || (!parameter.alias.empty() && same_name(parameter.alias, name));
}

const LibraryParameter* find_named(const std::vector<LibraryParameter>& parameters, std::string_view name) {
  const auto found =
      std::find_if(parameters.begin(), parameters.end(), [name](const auto& each) { return named(each, name); });
  return found == parameters.end() ? nullptr : &*found;
}

// Splits "IN12" into "IN" and 12.
std::pair<std::string_view, unsigned> split_number(std::string_view name) {
  const std::size_t letters = name.find_last_not_of("0123456789") + 1;
  unsigned number = 0;
  std::from_chars(name.data() + letters, name.data() + name.size(), number);
  return {name.substr(0, letters), number};
}

}  // namespace

std::string_view name_of(Generic type) noexcept {
  return kGenerics[static_cast<std::size_t>(type)];
}

bool accepts(LibraryType parameter, Elementary type) noexcept {
  if (const auto* fixed = std::get_if<Elementary>(&parameter)) {
    return *fixed == type;
  }
  switch (std::get<Generic>(parameter)) {
    case Generic::Any:
    case Generic::AnyElementary:
      return true;
    case Generic::AnyNum:
      return is_num(type);
    case Generic::AnyInt:
      return is_int(type);
    case Generic::AnyReal:
      return is_real(type);
    case Generic::AnyBit:
      return is_bit(type);
  }
  return false;
}

std::optional<std::size_t> LibraryFunction::position(std::string_view input) const {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    if (named(inputs[i], input)) {
      return i;
    }
  }
  if (!extensible || input.empty()) {
    return std::nullopt;
  }
  const auto [last_letters, last_number] = split_number(inputs.back().name);
  const auto [letters, number] = split_number(input);
  const bool further = same_name(letters, last_letters) && number > last_number && input[letters.size()] != '0';
  return further ? std::optional(inputs.size() - 1 + number - last_number) : std::nullopt;
}

const LibraryParameter& LibraryFunction::input(std::size_t position) const {
  return inputs[std::min(position, inputs.size() - 1)];
}

const LibraryParameter* LibraryBlock::input(std::string_view wanted) const {
  return find_named(inputs, wanted);
}

const LibraryParameter* LibraryBlock::output(std::string_view wanted) const {
  return find_named(outputs, wanted);
}

const std::vector<LibraryFunction>& library_functions() {
  static const std::vector<LibraryFunction> kAll = make_functions();
  return kAll;
}

const std::vector<LibraryBlock>& library_blocks() {
  static const std::vector<LibraryBlock> kAll = make_blocks();
  return kAll;
}

std::vector<const LibraryFunction*> find_functions(std::string_view name) {
  const std::string wanted = with_long_type_names(name);
  std::vector<const LibraryFunction*> found;
  for (const LibraryFunction& function : library_functions()) {
    if (function.name == wanted) {
      found.push_back(&function);
    }
  }
  return found;
}

const LibraryBlock* find_block(std::string_view name) {
  name.remove_prefix(name.starts_with('@') ? 1 : 0);
  const auto& all = library_blocks();
  const auto found =
      std::find_if(all.begin(), all.end(), [name](const LibraryBlock& block) { return same_name(block.name, name); });
  return found == all.end() ? nullptr : &*found;
}

std::string_view name_in_standard(std::string_view path) noexcept {
  const std::size_t dot = path.find('.');
  const bool known = dot != std::string_view::npos &&
                     (same_name(path.substr(0, dot), "Standard") || same_name(path.substr(0, dot), "Tc2_Standard"));
  return known ? path.substr(dot + 1) : std::string_view();
}

}  // namespace indurop::plc

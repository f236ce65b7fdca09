// SPDX-License-Identifier: Apache-2.0
#include "tests/unit/control/plc/growth/growing_programs.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/unit/control/plc/growth/growing_drawings.h"

namespace indurop::plc::testing {
namespace {

using Size = std::size_t;

// `text` n times, with its number for each '#', the one before for '<', the one behind for '>'.
std::string repeated(Size n, std::string_view text, Size from = 0) {
  std::string out;
  for (Size i = from; i < n; ++i) {
    for (const char c : text) {
      switch (c) {
        case '#':
          out += std::to_string(i);
          break;
        case '<':
          out += std::to_string(i - 1);
          break;
        case '>':
          out += std::to_string(i + 1);
          break;
        default:
          out += c;
      }
    }
  }
  return out;
}

std::string times(Size n, std::string_view text) {
  std::string out;
  for (Size i = 0; i < n; ++i) {
    out += text;
  }
  return out;
}

std::string number(Size n) {
  return std::to_string(n);
}

std::string program(const std::string& variables, const std::string& body) {
  return "PROGRAM Main\n" + variables + "\n" + body + "\nEND_PROGRAM\n";
}

const std::string kInts = "VAR i, j : INT; b : BOOL; r : REAL; s : STRING; END_VAR";

std::string body(const std::string& text) {
  return program(kInts, text);
}

std::string types(const std::string& text) {
  return "TYPE\n" + text + "END_TYPE\n";
}

std::string inside(Size n, std::string_view before, std::string_view middle, std::string_view behind) {
  return times(n, before) + std::string(middle) + times(n, behind);
}

std::string reversed_chain(Size n, std::string_view text, std::string_view last) {
  return repeated(n, text) + repeated(n + 1, last, n);
}

constexpr const char* kFb = "FUNCTION_BLOCK ";
constexpr const char* kEnd = "END_FUNCTION_BLOCK\n";

std::string blocks(Size n, std::string_view variables, const std::string& first = "VAR_INPUT x : INT; END_VAR ") {
  return kFb + std::string("F0 ") + first + kEnd +
         repeated(n, kFb + std::string("F# VAR ") + std::string(variables) + " END_VAR " + kEnd, 1);
}

std::string with_main(std::string text, const std::string& variables = "", const std::string& statements = "") {
  return std::move(text) + program(kInts + variables, statements + " i := i + 1;");
}

std::string defines(Size n) {
  std::string out = "#define C0 1\n";
  for (Size i = 1; i < n; ++i) {
    out += "#define C" + number(i) + " C" + number(i - 1) + " + 1\n";
  }
  return out;
}

#define TEXT(expression) [](Size n) -> std::string { return expression; }

// clang-format off
const std::vector<GrowingText> kTexts = {
    GrowingText{"globals", TEXT("VAR_GLOBAL\n" + repeated(n, "g# : INT;\n") + "END_VAR\n" + program("", "g0 := 1;"))},
    GrowingText{"globals_used", TEXT("VAR_GLOBAL\n" + repeated(n, "g# : INT;\n") + "END_VAR\n" + program("", repeated(n, "g# := 1;\n")))},
    GrowingText{"globals_same", TEXT("VAR_GLOBAL\n" + times(n, "g : INT;\n") + "END_VAR\n" + program("", "g := 1;"))},
    GrowingText{"globals_of_words", TEXT("VAR_GLOBAL\n" + repeated(n, "g# : INT;\nG#_value : INT;\n") + "new : INT; new_value : INT; END_VAR\n" + program("", "g0 := 1;"))},
    GrowingText{"located", TEXT("VAR_GLOBAL\n" + repeated(n, "g# AT %MW# : INT;\n") + "END_VAR\n" + program("", "g0 := 1;"))},
    GrowingText{"located_used", TEXT(program("VAR i : INT; END_VAR", repeated(n, "i := %MW#;\n")))},
    GrowingText{"located_arrays", TEXT("VAR_GLOBAL\n" + repeated(n, "g# AT %MW#00 : ARRAY[0..9] OF INT;\n", 1) + "END_VAR\n" + program("", "g1[1] := 1;"))},
    GrowingText{"located_large", TEXT("VAR_GLOBAL a AT %MW0 : ARRAY[0.." + number(n * 1000) + "] OF INT; END_VAR\n" + program("VAR i : INT; END_VAR", repeated(100, "i := %MW#" + number(n) + ";\n", 1)))},
    GrowingText{"located_far", TEXT(program("VAR i : INT; END_VAR", repeated(20, "i := %MW" + number(n) + "00#;\n", 1)))},
    GrowingText{"placeless", TEXT("VAR_GLOBAL\n" + repeated(n, "g# AT %IW* : INT;\n") + "END_VAR\n" + program("VAR i : INT; END_VAR", "i := g0;"))},
    GrowingText{"externals", TEXT("VAR_GLOBAL\n" + repeated(n, "g# : INT;\n") + "END_VAR\n" + program("VAR_EXTERNAL\n" + repeated(n, "g# : INT;\n") + "END_VAR", repeated(n, "g# := 1;\n")))},
    GrowingText{"structs_shared", TEXT(types(repeated(n, "S# : STRUCT a, b : INT; END_STRUCT;\n")) + "VAR_GLOBAL\n" + repeated(n, "g# : S#;\n") + "END_VAR\n" + program("", repeated(n, "g#.a := 1;\n")))},
    GrowingText{"locals", TEXT(program("VAR\n" + repeated(n, "v# : INT;\n") + "END_VAR", repeated(n, "v# := 1;\n")))},
    GrowingText{"locals_retained", TEXT(program("VAR RETAIN\n" + repeated(n, "v# : INT;\n") + "END_VAR", repeated(n, "v# := 1;\n")))},
    GrowingText{"locals_of_struct", TEXT(types("S : STRUCT\n" + repeated(500, "f# : INT;\n") + "END_STRUCT;\n") + program("VAR\n" + repeated(n, "v# : S;\n") + "END_VAR", "v0.f0 := 1;"))},
    GrowingText{"constants_backwards", TEXT("VAR_GLOBAL CONSTANT\n" + reversed_chain(n, "c# : DINT := c> + 1;\n", "c# : DINT := 1;\n") + "END_VAR\n" + program("VAR i : DINT; END_VAR", "i := c0;"))},
    GrowingText{"constants_in_circle", TEXT("VAR_GLOBAL CONSTANT\n" + reversed_chain(n, "c# : DINT := c>;\n", "c# : DINT := c0;\n") + "END_VAR\n" + program("VAR i : DINT; END_VAR", "i := c0;"))},
    GrowingText{"constants_local", TEXT(program("VAR i : DINT; END_VAR VAR CONSTANT\n" + reversed_chain(n, "c# : DINT := c> + 1;\n", "c# : DINT := 1;\n") + "END_VAR", "i := c0;"))},
    GrowingText{"aliases", TEXT(with_main(types("T0 : INT;\n" + repeated(n, "T# : T<;\n", 1)), " VAR x : T" + number(n - 1) + "; END_VAR", "x := 1;"))},
    GrowingText{"aliases_backwards", TEXT(with_main(types(reversed_chain(n, "T# : T>;\n", "T# : INT;\n")), " VAR x : T0; END_VAR", "x := 1;"))},
    GrowingText{"aliases_in_circle", TEXT(with_main(types(reversed_chain(n, "T# : T>;\n", "T# : T0;\n"))))},
    GrowingText{"types_with_values", TEXT(with_main(types(repeated(n, "T# : INT := 5;\n"))))},
    GrowingText{"types_unknown", TEXT(with_main(types(repeated(n, "T# : U#;\n"))))},
    GrowingText{"subranges", TEXT(with_main(types(repeated(n, "T# : INT (0..#);\n", 1))))},
    GrowingText{"structs_nested", TEXT(with_main(types("S0 : STRUCT a : INT; END_STRUCT;\n" + repeated(n, "S# : STRUCT a : S<; END_STRUCT;\n", 1)), " VAR x : S" + number(n - 1) + "; END_VAR", "x := x;"))},
    GrowingText{"structs_nested_backwards", TEXT(with_main(types(reversed_chain(n, "S# : STRUCT a : S>; END_STRUCT;\n", "S# : STRUCT a : INT; END_STRUCT;\n")), " VAR x : S0; END_VAR", "x := x;"))},
    GrowingText{"structs_of_four", TEXT(with_main(types("S0 : STRUCT a, b, c, d : INT; END_STRUCT;\n" + repeated(n, "S# : STRUCT a, b, c, d : S<; END_STRUCT;\n", 1)), " VAR x : S" + number(n - 1) + "; END_VAR", "x := x;")), 3},
    GrowingText{"structs_of_four_shared", TEXT("VAR_GLOBAL x : S" + number(n - 1) + "; END_VAR\n" + types("S0 : STRUCT a, b, c, d : INT := 5; END_STRUCT;\n" + repeated(n, "S# : STRUCT a, b, c, d : S<; END_STRUCT;\n", 1)) + program("VAR y : S0; END_VAR", "y := y;")), 2},
    GrowingText{"structs_of_pointers", TEXT(with_main(types(reversed_chain(n, "S# : STRUCT a : POINTER TO S>; END_STRUCT;\n", "S# : STRUCT a : INT; END_STRUCT;\n")), " VAR x : S0; END_VAR", "x := x;"))},
    GrowingText{"structs_of_arrays", TEXT(with_main(types("S0 : STRUCT a : ARRAY[0..9] OF INT; END_STRUCT;\n" + repeated(n, "S# : STRUCT a : ARRAY[0..9] OF S<; END_STRUCT;\n", 1)), " VAR x : S" + number(n - 1) + "; END_VAR", "x := x;")), 2},
    GrowingText{"struct_extends", TEXT(with_main(types("S0 : STRUCT a0 : INT; END_STRUCT;\n" + repeated(n, "S# EXTENDS S< : STRUCT a# : INT; END_STRUCT;\n", 1)), " VAR x : S" + number(n - 1) + "; END_VAR", "x.a0 := 1;"))},
    GrowingText{"struct_extends_all", TEXT(with_main(types("S : STRUCT\n" + repeated(2000, "a# : INT;\n") + "END_STRUCT;\n" + repeated(n, "S# EXTENDS S : STRUCT b : INT; END_STRUCT;\n"))))},
    GrowingText{"struct_fields", TEXT(with_main(types("S : STRUCT\n" + repeated(n, "a# : INT;\n") + "END_STRUCT;\n"), " VAR x : S; END_VAR", repeated(n, "x.a# := 1;\n")))},
    GrowingText{"struct_fields_given", TEXT(with_main(types("S : STRUCT\n" + repeated(n, "a# : INT;\n") + "END_STRUCT;\n"), " VAR x : S := (a0 := 1" + repeated(n, ", a# := 1", 1) + "); END_VAR"))},
    GrowingText{"struct_fields_wrong", TEXT(with_main(types("S : STRUCT\n" + repeated(n, "a# : INT;\n") + "END_STRUCT;\n"), " VAR x : S; END_VAR", repeated(n, "x.b# := 1;\n")))},
    GrowingText{"struct_fields_same", TEXT(with_main(types("S : STRUCT\n" + times(n, "a : INT;\n") + "END_STRUCT;\n")))},
    GrowingText{"unions", TEXT(with_main(types("S : STRUCT\n" + repeated(500, "a# : INT;\n") + "END_STRUCT;\n" + repeated(n, "U# : UNION a : S; END_UNION;\n"))))},
    GrowingText{"struct_instances", TEXT(with_main(types(reversed_chain(n, "S# : STRUCT a : S>; END_STRUCT;\n", "S# : STRUCT a : TON; END_STRUCT;\n")), " VAR x : S0; END_VAR"))},
    GrowingText{"struct_instances_extended", TEXT(with_main(types("S0 : STRUCT a0 : TON; END_STRUCT;\n" + repeated(n, "S# EXTENDS S< : STRUCT a# : INT; END_STRUCT;\n", 1)), " VAR x : S" + number(n - 1) + "; END_VAR"))},
    GrowingText{"struct_instances_extended_all", TEXT(with_main(types("S : STRUCT t : TON;\n" + repeated(500, "a# : INT;\n") + "END_STRUCT;\n" + repeated(n, "S# EXTENDS S : STRUCT b : INT; END_STRUCT;\n")))), 50},
    GrowingText{"enum_values", TEXT(with_main(types("E : (" + repeated(n, "A#, ") + "Z);\n"), " VAR x : E; END_VAR", repeated(n, "x := A#;\n")))},
    GrowingText{"enum_values_named", TEXT(with_main(types("E : (" + repeated(n, "A#, ") + "Z);\n"), " VAR x : E; END_VAR", repeated(n, "x := E#A#;\n")))},
    GrowingText{"enum_values_compared", TEXT(with_main(types("E : (" + repeated(n, "A#, ") + "Z);\n"), " VAR x : E; END_VAR", "CASE x OF\n" + repeated(n, "A#: i := 1;\n") + "END_CASE;"))},
    GrowingText{"enums", TEXT(with_main(types(repeated(n, "E# : (A#, B#);\n")), "", repeated(n, "b := A# = E##A#;\n")))},
    GrowingText{"enums_of_same_values", TEXT(with_main(types(repeated(n, "E# : (A, B);\n")) + "VAR_GLOBAL\n" + repeated(n, "g# : E#;\n") + "END_VAR\n", "", repeated(n, "g# := A;\n")))},
    GrowingText{"enums_without_name", TEXT(program("VAR\n" + repeated(n, "v# : (A#, B#);\n") + "END_VAR", "v0 := A0;"))},
    GrowingText{"pointers_nested", TEXT(with_main(types("P0 : POINTER TO INT;\n" + repeated(n, "P# : POINTER TO P<;\n", 1)), " VAR x, y : P" + number(n - 1) + "; END_VAR", "x := y;"))},
    GrowingText{"pointers_nested_backwards", TEXT(with_main(types(reversed_chain(n, "P# : POINTER TO P>;\n", "P# : POINTER TO INT;\n")), " VAR x, y : P0; END_VAR", "x := y;"))},
    GrowingText{"pointers_written", TEXT(program("VAR p : " + times(n, "POINTER TO ") + "INT; END_VAR", ""))},
    GrowingText{"arrays_written", TEXT(program("VAR p : " + times(n, "ARRAY[0..1] OF ") + "INT; END_VAR", ""))},
    GrowingText{"arrays_nested", TEXT(with_main(types("A0 : ARRAY[0..1] OF INT;\n" + repeated(n, "A# : ARRAY[0..1] OF A<;\n", 1))))},
    GrowingText{"array_dimensions", TEXT(program("VAR p : ARRAY[0..0" + times(n, ", 0..0") + "] OF INT; END_VAR", ""))},
    GrowingText{"structs_written", TEXT(with_main(types("S : " + inside(n, "STRUCT a : ", "INT", "; END_STRUCT") + ";\n")))},
    GrowingText{"array_values", TEXT("VAR_GLOBAL a : ARRAY[0.." + number(n) + "] OF INT := [1" + repeated(n, ", #") + "]; END_VAR\n" + program("", "a[0] := 1;"))},
    GrowingText{"array_values_repeated", TEXT("VAR_GLOBAL a : ARRAY[0.." + number(n * 1000) + "] OF INT := [" + number(n * 1000 + 1) + "(5)]; END_VAR\n" + program("", "a[0] := 1;"))},
    GrowingText{"array_values_two", TEXT(program("VAR a : ARRAY[0.." + number(n * 1000) + "] OF INT := [" + number(n * 500) + "(5), " + number(n * 500) + "(6)]; END_VAR", "a[0] := 1;")), 10},
    GrowingText{"array_values_first", TEXT(program("VAR a : ARRAY[0.." + number(n * 30000) + "] OF INT := [5]; END_VAR", "a[0] := 1;"))},
    GrowingText{"array_values_many", TEXT(program("VAR\n" + repeated(n, "a# : ARRAY[0..99999] OF INT := [50000(1), 50000(2)];\n") + "END_VAR", "a0[0] := 1;")), 50},
    GrowingText{"array_values_of_type", TEXT(types("T : ARRAY[0..99999] OF INT := [50000(1), 50000(2)];\n") + program("VAR\n" + repeated(n, "a# : T;\n") + "END_VAR", "a0[0] := 1;")), 50},
    GrowingText{"array_values_two_dimensions", TEXT(program("VAR a : ARRAY[0.." + number(n) + ", 0..99] OF INT := [1" + repeated(n, ", #") + "]; END_VAR", "a[0, 0] := 1;"))},
    GrowingText{"array_values_inside", TEXT(program("VAR a : INT := " + inside(n, "[", "1", "]") + "; END_VAR", ""))},
    GrowingText{"array_values_of_structs", TEXT(types("S : STRUCT a, b, c : INT; END_STRUCT;\n") + program("VAR a : ARRAY[0.." + number(n) + "] OF S := [(a := 1)" + repeated(n, ", (b := #)") + "]; END_VAR", "a[0].a := 1;"))},
    GrowingText{"array_of_subranges", TEXT("VAR_GLOBAL a : ARRAY[0.." + number(n * 1000) + "] OF INT (5..9) := [6]; END_VAR\n" + program("", "a[0] := 6;")), 10},
    GrowingText{"blocks_nested", TEXT(with_main(blocks(n, "a : F<;"), " VAR x : F" + number(n - 1) + "; END_VAR", "x();"))},
    GrowingText{"blocks_nested_backwards", TEXT(with_main(reversed_chain(n, "FUNCTION_BLOCK F# VAR a : F>; END_VAR END_FUNCTION_BLOCK\n", "FUNCTION_BLOCK F# VAR a : INT; END_VAR END_FUNCTION_BLOCK\n"), " VAR x : F0; END_VAR", "x();"))},
    GrowingText{"blocks_of_four", TEXT(with_main(blocks(n, "a, b, c, d : F<;"), " VAR x : F" + number(n - 1) + "; END_VAR", "x();")), 2},
    GrowingText{"blocks_of_four_placed", TEXT(with_main(blocks(n, "a, b, c, d : F<;", "VAR p AT %IW* : INT; END_VAR "), " VAR RETAIN x : F" + number(n - 1) + "; END_VAR", "x();")), 2},
    GrowingText{"blocks_in_circle", TEXT(with_main(reversed_chain(n, "FUNCTION_BLOCK F# VAR a : F>; END_VAR END_FUNCTION_BLOCK\n", "FUNCTION_BLOCK F# VAR RETAIN a : F0; END_VAR END_FUNCTION_BLOCK\n")))},
    GrowingText{"blocks_called", TEXT(with_main("FUNCTION_BLOCK F VAR_INPUT x : INT; END_VAR VAR_OUTPUT y : INT; END_VAR y := x; END_FUNCTION_BLOCK\n", " VAR\n" + repeated(n, "f# : F;\n") + "END_VAR", repeated(n, "f#(x := 1); i := f#.y;\n")))},
    GrowingText{"blocks_of_library", TEXT(program("VAR\n" + repeated(n, "t# : TON;\n") + "END_VAR", repeated(n, "t#(IN := t#.Q, PT := T#1s);\n")))},
    GrowingText{"blocks_array", TEXT(program("VAR t : ARRAY[0.." + number(n * 5) + "] OF TON; END_VAR", "t[1](IN := TRUE);"))},
    GrowingText{"blocks_array_retained", TEXT(program("VAR RETAIN t : ARRAY[0.." + number(n) + "] OF TON; END_VAR", "t[1](IN := TRUE);")), 100},
    GrowingText{"blocks_array_given", TEXT(program("VAR RETAIN t : ARRAY[0.." + number(n) + "] OF TON := [(PT := T#1s)" + times(n, ", (PT := T#2s)") + "]; END_VAR", "t[1](IN := TRUE);")), 100},
    GrowingText{"blocks_array_huge", TEXT(program("VAR t : ARRAY[0.." + number(n * 30000) + "] OF TON; END_VAR", "t[1](IN := TRUE);"))},
    GrowingText{"blocks_array_nested", TEXT(with_main(blocks(n, "a : ARRAY[0..99] OF F<;"), " VAR x : F" + number(n - 1) + "; END_VAR", "x();")), 2},
    GrowingText{"blocks_inputs", TEXT(with_main("FUNCTION_BLOCK F VAR_INPUT\n" + repeated(n, "x# : INT;\n") + "END_VAR\n" + repeated(n, "x0 := x#;\n") + "END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", "f(x0 := 1" + repeated(n, ", x# := 1", 1) + ");"))},
    GrowingText{"blocks_inputs_called", TEXT(with_main("FUNCTION_BLOCK F VAR_INPUT\n" + repeated(n, "x# : INT;\n") + "END_VAR\n i := 1; END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", times(n, "f(x0 := 1);\n")))},
    GrowingText{"blocks_inputs_wrong", TEXT(with_main("FUNCTION_BLOCK F VAR_INPUT\n" + repeated(n, "x# : INT;\n") + "END_VAR\n END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", times(n, "f(y0 := 1);\n")))},
    GrowingText{"block_extends", TEXT(with_main(kFb + std::string("F0 VAR a0 : INT; END_VAR ") + kEnd + repeated(n, "FUNCTION_BLOCK F# EXTENDS F< VAR a# : INT; END_VAR END_FUNCTION_BLOCK\n", 1), " VAR x : F" + number(n - 1) + "; END_VAR", "x();"))},
    GrowingText{"block_extends_backwards", TEXT(with_main(reversed_chain(n, "FUNCTION_BLOCK F# EXTENDS F> VAR a# : INT; END_VAR END_FUNCTION_BLOCK\n", "FUNCTION_BLOCK F# VAR a# : INT; END_VAR END_FUNCTION_BLOCK\n"), " VAR x : F0; END_VAR", "x();"))},
    GrowingText{"block_extends_in_circle", TEXT(with_main(reversed_chain(n, "FUNCTION_BLOCK F# EXTENDS F> END_FUNCTION_BLOCK\n", "FUNCTION_BLOCK F# EXTENDS F0 END_FUNCTION_BLOCK\n")))},
    GrowingText{"block_extended_by_all", TEXT(with_main("FUNCTION_BLOCK F VAR\n" + repeated(200, "a# : INT;\n") + "END_VAR METHOD M i := 1; END_METHOD END_FUNCTION_BLOCK\n" + repeated(n, "FUNCTION_BLOCK F# EXTENDS F VAR b : INT; END_VAR END_FUNCTION_BLOCK\n"))), 100},
    GrowingText{"interface_extends", TEXT(with_main("INTERFACE I0 END_INTERFACE\n" + repeated(n, "INTERFACE I# EXTENDS I< METHOD M# END_METHOD END_INTERFACE\n", 1)))},
    GrowingText{"interface_diamonds", TEXT(with_main("INTERFACE I0 METHOD M0 END_METHOD END_INTERFACE INTERFACE J0 END_INTERFACE\n" + repeated(n, "INTERFACE I# EXTENDS I<, J< END_INTERFACE INTERFACE J# EXTENDS I<, J< END_INTERFACE\n", 1) + "FUNCTION_BLOCK F IMPLEMENTS I" + number(n - 1) + " METHOD M0 END_METHOD END_FUNCTION_BLOCK\n", " VAR f : F; x : I0; END_VAR", "x := f; x.M0();")), 6},
    GrowingText{"interfaces_implemented", TEXT(with_main(repeated(n, "INTERFACE I# METHOD M# END_METHOD END_INTERFACE\n") + "FUNCTION_BLOCK F IMPLEMENTS I0" + repeated(n, ", I#", 1) + "\n" + repeated(n, "METHOD M# END_METHOD\n") + "END_FUNCTION_BLOCK\n"))},
    GrowingText{"interface_missing", TEXT(with_main("INTERFACE I " + repeated(n, "METHOD M# END_METHOD\n") + "END_INTERFACE FUNCTION_BLOCK F IMPLEMENTS I END_FUNCTION_BLOCK\n"))},
    GrowingText{"methods", TEXT(with_main("FUNCTION_BLOCK F\n" + repeated(n, "METHOD M# : INT M# := 1; END_METHOD\n") + "END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", repeated(n, "i := f.M#();\n")))},
    GrowingText{"methods_inside", TEXT(with_main("FUNCTION_BLOCK F\n" + repeated(n, "METHOD M# : INT M# := 1; END_METHOD\n") + repeated(n, "M#();\n") + "END_FUNCTION_BLOCK\n"))},
    GrowingText{"methods_in_chain", TEXT(with_main("FUNCTION_BLOCK F\n" + reversed_chain(n, "METHOD M# M>(); END_METHOD\n", "METHOD M# END_METHOD\n") + "END_FUNCTION_BLOCK\n"))},
    GrowingText{"methods_same", TEXT(with_main("FUNCTION_BLOCK F\n" + times(n, "METHOD M : INT M := 1; END_METHOD\n") + "END_FUNCTION_BLOCK\n"))},
    GrowingText{"methods_replaced", TEXT(with_main("FUNCTION_BLOCK F\n" + repeated(n, "METHOD M# : INT M# := 1; END_METHOD\n") + "END_FUNCTION_BLOCK\nFUNCTION_BLOCK G EXTENDS F\n" + repeated(n, "METHOD M# : INT M# := 1; END_METHOD\n") + "END_FUNCTION_BLOCK\n"))},
    GrowingText{"properties", TEXT(with_main("FUNCTION_BLOCK F\n" + repeated(n, "PROPERTY P# : INT GET P# := 1; END_GET SET ; END_SET END_PROPERTY\n") + "END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", repeated(n, "f.P# := f.P# + 1;\n")))},
    GrowingText{"starts", TEXT(with_main("FUNCTION_BLOCK F METHOD FB_Init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; k : INT; END_VAR END_METHOD END_FUNCTION_BLOCK\n", " VAR\n" + repeated(n, "f# : F(#);\n") + "END_VAR"))},
    GrowingText{"starts_nested", TEXT(with_main("FUNCTION_BLOCK F0 METHOD FB_Init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; END_VAR END_METHOD END_FUNCTION_BLOCK\n" + repeated(n, "FUNCTION_BLOCK F# VAR a, b, c : F<; END_VAR END_FUNCTION_BLOCK\n", 1), " VAR x : F" + number(n - 1) + "; END_VAR", "x();")), 3},
    GrowingText{"starts_of_globals", TEXT("FUNCTION_BLOCK F METHOD FB_Init : BOOL VAR_INPUT bInitRetains, bInCopyCode : BOOL; k : INT; END_VAR END_METHOD END_FUNCTION_BLOCK\nVAR_GLOBAL\n" + repeated(n, "f# : F(#);\n") + "END_VAR\n" + program("", repeated(n, "f#();\n")))},
    GrowingText{"pointers_set", TEXT(program("VAR x : INT;\n" + repeated(n, "p# : POINTER TO INT := ADR(x);\n") + "END_VAR", "x := 1;"))},
    GrowingText{"functions", TEXT(repeated(n, "FUNCTION F# : INT VAR_INPUT x : INT; END_VAR F# := x; END_FUNCTION\n") + body(repeated(n, "i := F#(1);\n")))},
    GrowingText{"functions_in_chain", TEXT("FUNCTION F0 : INT F0 := 1; END_FUNCTION\n" + repeated(n, "FUNCTION F# : INT F# := F<(); END_FUNCTION\n", 1) + body("i := F" + number(n - 1) + "();"))},
    GrowingText{"functions_in_chain_backwards", TEXT(reversed_chain(n, "FUNCTION F# : INT F# := F>(); END_FUNCTION\n", "FUNCTION F# : INT F# := 1; END_FUNCTION\n") + body("i := F0();"))},
    GrowingText{"functions_in_circle", TEXT(reversed_chain(n, "FUNCTION F# : INT F# := F>(); END_FUNCTION\n", "FUNCTION F# : INT F# := F0(); END_FUNCTION\n") + body("i := F0();"))},
    GrowingText{"functions_back_to_all", TEXT(reversed_chain(n, "FUNCTION F# : INT F# := F>(); END_FUNCTION\n", "FUNCTION F# : INT " + repeated(n, "F" + number(n) + " := F#();\n") + " END_FUNCTION\n") + body("i := F0();"))},
    GrowingText{"functions_generic", TEXT("FUNCTION G : ANY_NUM VAR_INPUT x : ANY_NUM; END_VAR G := x; END_FUNCTION\n" + with_main(types(repeated(n, "T# : INT (0..#);\n", 1)), " VAR\n" + repeated(n, "v# : T#;\n", 1) + "END_VAR", repeated(n, "i := G(v#);\n", 1)))},
    GrowingText{"functions_generic_inside", TEXT("FUNCTION G : ANY_NUM VAR_INPUT x : ANY_NUM; END_VAR G := x; END_FUNCTION\n" + body("i := " + inside(n, "G(", "i", ")") + ";")), 10},
    GrowingText{"functions_generic_numbers", TEXT("FUNCTION G : ANY_NUM VAR_INPUT x : ANY_NUM; END_VAR G := x; END_FUNCTION\n" + body("i := " + inside(n, "G(", "1", ")") + ";")), 10},
    GrowingText{"functions_unknown", TEXT(body(repeated(n, "i := F#(1);\n")))},
    GrowingText{"functions_inputs", TEXT("FUNCTION F : INT VAR_INPUT\n" + repeated(n, "x# : INT;\n") + "END_VAR F := x0; END_FUNCTION\n" + body("i := F(1" + times(n - 1, ", 1") + ");"))},
    GrowingText{"functions_same", TEXT(times(n, "FUNCTION F : INT F := 1; END_FUNCTION\n") + body("i := F();"))},
    GrowingText{"functions_of_c", TEXT("FUNCTION_BLOCK F0 {{ x }} END_FUNCTION_BLOCK\n" + repeated(n, "FUNCTION_BLOCK F# VAR a : F<; END_VAR END_FUNCTION_BLOCK\n", 1) + body("i := 1;"))},
    GrowingText{"functions_of_c_backwards", TEXT(reversed_chain(n, "FUNCTION_BLOCK F# VAR a : F>; END_VAR END_FUNCTION_BLOCK\n", "FUNCTION_BLOCK F# {{ x }} END_FUNCTION_BLOCK\n") + body("i := 1;"))},
    GrowingText{"statements", TEXT(body(times(n, "i := i + 1;\n")))},
    GrowingText{"statements_after_exit", TEXT(body("RETURN;\n" + times(n, "i := i + 1;\n")))},
    GrowingText{"assignments", TEXT(body(times(n, "i := ") + "1;"))},
    GrowingText{"elsif", TEXT(body("IF b THEN i := 1;\n" + repeated(n, "ELSIF i = # THEN i := 2;\n") + "END_IF;"))},
    GrowingText{"case_labels", TEXT(body("CASE i OF\n" + repeated(n, "#: j := 1;\n") + "END_CASE;"))},
    GrowingText{"case_labels_same", TEXT(body("CASE i OF\n" + times(n, "1: j := 1;\n") + "END_CASE;"))},
    GrowingText{"case_ranges", TEXT(body("CASE i OF 0" + repeated(n, ", #..#", 1) + ": j := 1; END_CASE;"))},
    GrowingText{"if_inside", TEXT(body(inside(n, "IF b THEN ", "i := 1;", " END_IF;"))), 30},
    GrowingText{"for_inside", TEXT(program("VAR\n" + repeated(n, "i# : INT;\n") + "x : INT; END_VAR", repeated(n, "FOR i# := 1 TO 2 DO ") + "x := 1;" + times(n, " END_FOR;"))), 15},
    GrowingText{"loops", TEXT(body(times(n, "WHILE TRUE DO i := 1; END_WHILE;\n")))},
    GrowingText{"labels", TEXT(body(repeated(n, "JMP l#; l#: i := i + 1;\n")))},
    GrowingText{"calls_inside", TEXT(body("i := " + inside(n, "MAX(1, ", "i", ")") + ";")), 10},
    GrowingText{"calls_inside_numbers", TEXT(body("i := " + inside(n, "MAX(1, ", "2", ")") + ";")), 10},
    GrowingText{"calls_inside_conversions", TEXT(body("s := " + inside(n, "CONCAT(s, ", "s", ")") + ";")), 10},
    GrowingText{"calls_inside_selections", TEXT(body("i := " + inside(n, "SEL(b, 1, ", "2", ")") + ";")), 10},
    GrowingText{"calls_inside_functions", TEXT("FUNCTION F : INT VAR_INPUT x : INT; END_VAR F := x; END_FUNCTION\n" + body("i := " + inside(n, "F(", "i", ")") + ";")), 10},
    GrowingText{"calls_inside_methods", TEXT(with_main("FUNCTION_BLOCK F METHOD M : INT VAR_INPUT x : INT; END_VAR M := x; END_METHOD END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", "i := " + inside(n, "f.M(", "i", ")") + ";")), 10},
    GrowingText{"calls_behind_calls", TEXT(with_main("FUNCTION_BLOCK F METHOD M : REFERENCE TO F M REF= THIS^; END_METHOD END_FUNCTION_BLOCK\n", " VAR f : F; END_VAR", "f" + times(n, ".M()") + ";")), 10},
    GrowingText{"calls_inside_enumerations", TEXT(with_main(types("E : (A, B);\n"), " VAR e : E; END_VAR", "e := " + inside(n, "SEL(b, A, ", "B", ")") + ";")), 10},
    GrowingText{"brackets", TEXT(body("i := " + inside(n, "(", "i", ")") + ";")), 12},
    GrowingText{"brackets_numbers", TEXT(body("i := " + inside(n, "(1 + ", "2", ")") + ";")), 12},
    GrowingText{"brackets_compared", TEXT(body("b := " + inside(n, "(b = (i = ", "2", "))") + ";")), 6},
    GrowingText{"brackets_reals", TEXT(body("r := " + inside(n, "(1.5 * ", "r", ")") + ";")), 12},
    GrowingText{"indices_inside", TEXT(program("VAR a : ARRAY[0..9] OF INT; END_VAR", "a[0] := " + inside(n, "a[", "1", "]") + ";")), 10},
    GrowingText{"signs", TEXT(body("i := " + times(n, "- ") + "i;")), 90},
    GrowingText{"nots", TEXT(body("b := " + times(n, "NOT ") + "b;")), 90},
    GrowingText{"sums", TEXT(body("i := i" + times(n, " + i") + ";")), 90},
    GrowingText{"sums_of_numbers", TEXT(body("i := 1" + times(n, " - 1") + ";")), 90},
    GrowingText{"ands", TEXT(body("b := b" + times(n, " AND b") + ";")), 90},
    GrowingText{"sums_too_long", TEXT(body("i := i" + times(n, " + i") + ";"))},
    GrowingText{"derefs", TEXT(program("VAR p : POINTER TO INT; i : INT; END_VAR", "i := p" + times(n, "^") + ";"))},
    GrowingText{"members", TEXT(body("i := i" + times(n, ".a") + ";"))},
    GrowingText{"powers", TEXT(body(times(n, "r := r ** 2.0;\n")))},
    GrowingText{"namespaces_inside", TEXT(repeated(n, "NAMESPACE N#\n") + "FUNCTION F : INT F := 1; END_FUNCTION\n" + times(n, "END_NAMESPACE\n") + body("i := 1;"))},
    GrowingText{"namespaces_dotted", TEXT("NAMESPACE N" + repeated(n, ".N#") + "\nFUNCTION F : INT F := 1; END_FUNCTION FUNCTION G : INT G := F(); END_FUNCTION END_NAMESPACE\n" + body("i := 1;"))},
    GrowingText{"namespaces", TEXT(repeated(n, "NAMESPACE N# FUNCTION F : INT F := 1; END_FUNCTION END_NAMESPACE\n") + body(repeated(n, "i := N#.F();\n")))},
    GrowingText{"namespaces_used", TEXT(repeated(n, "NAMESPACE N# FUNCTION F# : INT F# := 1; END_FUNCTION END_NAMESPACE\n") + repeated(n, "USING N#;\n") + body(repeated(n, "i := F#();\n")))},
    GrowingText{"namespaces_same_names", TEXT(repeated(n, "NAMESPACE N# FUNCTION F : INT F := 1; END_FUNCTION END_NAMESPACE FUNCTION N#_F : INT END_FUNCTION\n") + body("i := 1;"))},
    GrowingText{"tasks", TEXT("PROGRAM P VAR i : INT; END_VAR i := i + 1; END_PROGRAM\nCONFIGURATION c RESOURCE r ON pc\n" + repeated(n, "TASK t# (INTERVAL := T#1ms, PRIORITY := 1);\n") + repeated(n, "PROGRAM p# WITH t# : P;\n") + "END_RESOURCE END_CONFIGURATION\n"), 50},
    GrowingText{"programs", TEXT(repeated(n, "PROGRAM P# VAR i : INT; END_VAR i := i + 1; END_PROGRAM\n"))},
    GrowingText{"program_instances", TEXT("PROGRAM P VAR RETAIN i : INT; END_VAR i := i + 1; END_PROGRAM\nCONFIGURATION c RESOURCE r ON pc TASK t (INTERVAL := T#1ms);\n" + repeated(n, "PROGRAM p# WITH t : P;\n") + "END_RESOURCE END_CONFIGURATION\n")},
    GrowingText{"resources", TEXT("PROGRAM P VAR i : INT; END_VAR i := i + 1; END_PROGRAM\nCONFIGURATION c\n" + repeated(n, "RESOURCE r# ON pc TASK t (INTERVAL := T#1ms); PROGRAM p WITH t : P; END_RESOURCE\n") + "END_CONFIGURATION\n"), 50},
    GrowingText{"accesses", TEXT("PROGRAM P VAR i : INT; END_VAR i := i + 1; END_PROGRAM\nCONFIGURATION c RESOURCE r ON pc TASK t (INTERVAL := T#1ms); PROGRAM p WITH t : P; END_RESOURCE\nVAR_ACCESS\n" + repeated(n, "a# : r.p.i : INT READ_WRITE;\n") + "END_VAR END_CONFIGURATION\n")},
    GrowingText{"configured", TEXT("PROGRAM P VAR\n" + repeated(n, "i# AT %IW* : INT;\n") + "k : INT; END_VAR k := i0; END_PROGRAM\nCONFIGURATION c RESOURCE r ON pc TASK t (INTERVAL := T#1ms); PROGRAM p WITH t : P; END_RESOURCE\nVAR_CONFIG\n" + repeated(n, "r.p.i# AT %IW# : INT;\n") + "END_VAR END_CONFIGURATION\n")},
    GrowingText{"connections", TEXT("VAR_GLOBAL g : INT; END_VAR PROGRAM P VAR_INPUT\n" + repeated(n, "i# : INT;\n") + "END_VAR i0 := 1; END_PROGRAM\nCONFIGURATION c RESOURCE r ON pc TASK t (INTERVAL := T#1ms); PROGRAM p WITH t : P (i0 := g" + repeated(n, ", i# := g", 1) + "); END_RESOURCE END_CONFIGURATION\n")},
    GrowingText{"undeclared", TEXT(body(repeated(n, "x# := 1;\n")))},
    GrowingText{"undeclared_among_many", TEXT(program("VAR\n" + repeated(n, "v# : INT;\n") + "END_VAR", repeated(n, "x# := 1;\n")))},
    GrowingText{"nonsense", TEXT(body(times(n, "i := := 1;\n")))},
    GrowingText{"nonsense_outside", TEXT(times(n, "nonsense ; "))},
    GrowingText{"programs_without_end", TEXT(repeated(n, "PROGRAM P# i := 1;\n"))},
    GrowingText{"functions_without_end", TEXT(repeated(n, "FUNCTION F# : INT F# := 1;\n"))},
    GrowingText{"blocks_without_end", TEXT(repeated(n, "FUNCTION_BLOCK F# VAR i : INT; END_VAR\n"))},
    GrowingText{"structs_without_end", TEXT("TYPE\n" + repeated(n, "S# : STRUCT a : INT;\n"))},
    GrowingText{"if_without_end", TEXT(body(times(n, "IF b THEN\n")))},
    GrowingText{"brackets_open", TEXT(body("i := " + times(n, "(") + ";\n"))},
    GrowingText{"comments_inside", TEXT(times(n, "(*") + times(n, "*)") + body("i := 1;"))},
    GrowingText{"comments_open", TEXT(body(times(n, "(* ")))},
    GrowingText{"comments_many", TEXT(body(times(n, "i := 1; // comment\n(* comment *) ")))},
    GrowingText{"pragmas", TEXT(times(n, "{attribute 'x'}\n") + body("i := 1;"))},
    GrowingText{"pragmas_open", TEXT(body(times(n, "{ ")))},
    GrowingText{"texts", TEXT(body(times(n, "s := 'abc$N';\n")))},
    GrowingText{"text_long", TEXT(body("s := '" + times(n * 20, "abc$'") + "';"))},
    GrowingText{"text_open", TEXT(body(times(n, "s := 'abc;\n")))},
    GrowingText{"number_long", TEXT(body("i := " + times(n * 10, "1") + ";"))},
    GrowingText{"line_long", TEXT(body(times(n, "x := 1; ")))},
    GrowingText{"actions", TEXT(program("VAR i : INT; END_VAR", repeated(n, "A#();\n")) + "") },
    GrowingText{"actions_behind", TEXT("PROGRAM Main VAR i : INT; END_VAR\n" + repeated(n, "A#();\n") + "END_PROGRAM\n" + repeated(n, "ACTION A#: i := i + 1; END_ACTION\n"))},
    GrowingText{"actions_in_chain", TEXT("PROGRAM Main VAR i : INT; END_VAR A0(); END_PROGRAM\n" + reversed_chain(n, "ACTION A#: A>(); END_ACTION\n", "ACTION A#: i := 1; END_ACTION\n")), 10},
    GrowingText{"actions_doubled", TEXT("PROGRAM Main VAR i : INT; END_VAR A0(); END_PROGRAM\n" + reversed_chain(n, "ACTION A#: A>(); A>(); END_ACTION\n", "ACTION A#: i := 1; END_ACTION\n")), 4},
    GrowingText{"list", TEXT(program("VAR i : INT; END_VAR", "\n" + times(n, "LD i\nADD 1\nST i\n")))},
    GrowingText{"list_brackets", TEXT(program("VAR i : INT; END_VAR", "\nLD i\n" + times(n, "ADD(\nLD i\n") + times(n, ")\n") + "ST i\n")), 10},
    GrowingText{"list_long", TEXT(program("VAR i : INT; END_VAR", "\nLD i\n" + times(n, "ADD 1\n") + "ST i\n"))},
    GrowingText{"list_jumps", TEXT(program("VAR i : BOOL; END_VAR", "\n" + repeated(n, "LD i\nJMPC l#\nl#: ST i\n")))},
    GrowingText{"chart", TEXT(program("VAR b : BOOL; END_VAR", "INITIAL_STEP S0: END_STEP\n" + repeated(n, "STEP S#: b(N); END_STEP TRANSITION FROM S< TO S# := b; END_TRANSITION\n", 1)))},
    GrowingText{"chart_wide", TEXT(program("VAR b : BOOL; END_VAR", "INITIAL_STEP S0: END_STEP\n" + repeated(n, "STEP S#: b(N); END_STEP\n", 1) + "TRANSITION FROM S0 TO (S1" + repeated(n, ", S#", 2) + ") := b; END_TRANSITION\n"))},
    GrowingText{"chart_crosswise", TEXT(program("VAR b : BOOL; END_VAR", "INITIAL_STEP S0: END_STEP STEP R0: END_STEP\n" + repeated(n, "STEP S#: END_STEP STEP R#: END_STEP TRANSITION FROM S< TO (S#, R#) := b; END_TRANSITION TRANSITION FROM R< TO (S#, R#) := b; END_TRANSITION\n", 1))), 8},
    GrowingText{"chart_actions", TEXT(program("VAR b : BOOL; END_VAR", "INITIAL_STEP S0: " + repeated(n, "A#(N); ") + "END_STEP TRANSITION FROM S0 TO S0 := b; END_TRANSITION\n" + repeated(n, "ACTION A#: b := TRUE; END_ACTION\n")))},
    GrowingText{"charts_inside", TEXT(program("VAR b : BOOL; END_VAR", "INITIAL_STEP S: A0(N); END_STEP TRANSITION FROM S TO S := b; END_TRANSITION\n" + reversed_chain(n, "ACTION A#: INITIAL_STEP S#: A>(N); END_STEP TRANSITION FROM S# TO S# := b; END_TRANSITION END_ACTION\n", "ACTION A#: b := TRUE; END_ACTION\n"))), 4},
    GrowingText{"rungs", &rungs, 50, "in.xml"},
    GrowingText{"contacts_in_series", &contacts_in_series, 50, "in.xml"},
    GrowingText{"contacts_in_parallel", &contacts_in_parallel, 50, "in.xml"},
    GrowingText{"contacts_crosswise", &contacts_crosswise, 6, "in.xml"},
    GrowingText{"blocks_in_series", &blocks_in_series, 50, "in.xml"},
    GrowingText{"blocks_doubled", &blocks_doubled, 6, "in.xml"},
    GrowingText{"blocks_far_apart", &blocks_far_apart, 100, "in.xml"},
    GrowingText{"rungs_wide", &rungs_wide, 400, "in.xml"},
    GrowingText{"networks", &networks, 50, "in.xml"},
    GrowingText{"connectors", &connectors, 50, "in.xml"},
    GrowingText{"xml_deep", TEXT("<?xml version='1.0'?>" + times(n, "<a>") + times(n, "</a>")), 400, "in.xml"},
    GrowingText{"xml_attributes", TEXT("<?xml version='1.0'?><project " + repeated(n, "a#='1' ") + "/>"), 400, "in.xml"},
    GrowingText{"glb_variables", TEXT("namespace a;\n" + repeated(n, "int32_t v#;\n")), 400, "in.glb"},
    GrowingText{"glb_values", TEXT("namespace a;\n" + repeated(n, "int32_t v# = #;\n")), 400, "in.glb"},
    GrowingText{"glb_constants", TEXT("namespace a;\n" + defines(n)), 400, "in.glb"},
    GrowingText{"glb_structs_nested", TEXT("namespace a;\nstruct S0 { int32_t a; };\n" + repeated(n, "struct S# { S< a; };\n", 1)), 400, "in.glb"},
    GrowingText{"glb_structs_of_four", TEXT("namespace a;\nstruct S0 { int32_t a, b, c, d; };\n" + repeated(n, "struct S# { S< a, b, c, d; };\n", 1) + "S" + number(n - 1) + " v;\n"), 3, "in.glb"},
    GrowingText{"glb_structs_written", TEXT("namespace a;\n" + times(n, "struct { ") + "int32_t x; " + times(n, "} a; ")), 400, "in.glb"},
    GrowingText{"glb_fields", TEXT("namespace a;\nstruct S {\n" + repeated(n, "int32_t f#;\n") + "};\nS v;\n"), 400, "in.glb"},
    GrowingText{"glb_of_large_struct", TEXT("namespace a;\nstruct S {\n" + repeated(1000, "int32_t f#;\n") + "};\n" + repeated(n, "S v#;\n")), 400, "in.glb"},
    GrowingText{"glb_of_large_enum", TEXT("namespace a;\nenum E { " + repeated(1000, "A#, ") + "Z };\n" + repeated(n, "E v#;\n")), 400, "in.glb"},
    GrowingText{"glb_aliases", TEXT("namespace a;\ntypedef int32_t T0;\n" + repeated(n, "typedef T< T#;\n", 1) + "T0 v;\n"), 400, "in.glb"},
    GrowingText{"glb_enums", TEXT("namespace a;\n" + repeated(n, "enum E# { A#, B# };\nE# v#;\n")), 400, "in.glb"},
    GrowingText{"glb_functions", TEXT("namespace a;\n" + repeated(n, "int32_t f#(int32_t a, int32_t b);\n")), 400, "in.glb"},
    GrowingText{"glb_parameters", TEXT("namespace a;\nvoid f(int32_t p" + repeated(n, ", int32_t p#") + ");\n"), 400, "in.glb"},
    GrowingText{"glb_namespaces", TEXT(repeated(n, "namespace n#;\nint32_t v;\n")), 400, "in.glb"},
    GrowingText{"glb_namespace_long", TEXT("namespace n" + repeated(n, ".n#") + ";\nint32_t v;\n"), 400, "in.glb"},
    GrowingText{"glb_brackets", TEXT("namespace a;\nint32_t v = " + inside(n, "(", "1", ")") + ";\n"), 20, "in.glb"},
    GrowingText{"glb_signs", TEXT("namespace a;\nint32_t v = " + times(n, "- ") + "1;\n"), 20, "in.glb"},
    GrowingText{"glb_sums", TEXT("namespace a;\nint32_t v = 1" + times(n, " + 1") + ";\n"), 400, "in.glb"},
    GrowingText{"glb_choices", TEXT("namespace a;\nint32_t v = " + times(n, "1 ? 2 : ") + "1;\n"), 20, "in.glb"},
    GrowingText{"glb_lists", TEXT("namespace a;\nint32_t v[" + number(n + 1) + "] = {1" + times(n, ", 1") + "};\n"), 400, "in.glb"},
    GrowingText{"glb_lists_inside", TEXT("namespace a;\nint32_t v = " + inside(n, "{", "1", "}") + ";\n"), 20, "in.glb"},
    GrowingText{"glb_dimensions", TEXT("namespace a;\nint32_t v" + times(n, "[1]") + ";\n"), 20, "in.glb"},
    GrowingText{"glb_unknown", TEXT("namespace a;\n" + repeated(n, "T# v#;\n")), 400, "in.glb"},
    GrowingText{"glb_nonsense", TEXT("namespace a;\n" + repeated(n, "int32_t = ;\n")), 400, "in.glb"},
    GrowingText{"glb_alarms", TEXT("namespace a;\nbool v " + times(n, "@alarm(\"x\") ") + ";\n"), 400, "in.glb"},
    GrowingText{"glb_comments", TEXT("namespace a;\n" + times(n, "// comment\n") + "int32_t v;\n"), 400, "in.glb"},
    GrowingText{"glb_text", TEXT("namespace a;\nchar v[10] = " + times(n, "\"\" ") + ";\n"), 400, "in.glb"},
};
// clang-format on

}  // namespace

std::span<const GrowingText> growing_texts() {
  return kTexts;
}

}  // namespace indurop::plc::testing

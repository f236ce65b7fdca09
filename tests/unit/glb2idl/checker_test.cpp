// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "tests/unit/glb2idl/compile_helper.h"

namespace indurop::glb2idl {
namespace {

using test::compile_files;
using test::compile_text;
using test::messages;
using test::variable;
using ::testing::HasSubstr;
using ::testing::Not;

std::string type_of(const std::string& declaration) {
  return schema::canonical(variable(compile_text(declaration), "x").type);
}

TEST(Types, C_words_mean_the_same_on_every_board_in_any_order) {
  EXPECT_EQ(type_of("char x"), "char");
  EXPECT_EQ(type_of("signed char x"), "i8");
  EXPECT_EQ(type_of("char unsigned x"), "u8");
  EXPECT_EQ(type_of("short x"), "i16");
  EXPECT_EQ(type_of("int short unsigned x"), "u16");
  EXPECT_EQ(type_of("unsigned x"), "u32");
  EXPECT_EQ(type_of("long x"), "i64");
  EXPECT_EQ(type_of("long unsigned int long x"), "u64");
  EXPECT_EQ(type_of("int8 x"), "i8");
  EXPECT_EQ(type_of("uint64_t x"), "u64");
  EXPECT_EQ(type_of("bool x"), "bool");
}

TEST(Types, Structs_are_laid_out_as_in_C) {
  struct Inner {
    char name[5];
    double number;
  };
  struct Outer {
    bool flag;
    Inner inner[2];
    short word;
    long long big;
    unsigned char last;
  };
  const schema::Type sut = variable(compile_text("struct I { char name[5]; double number; };\n"
                                                 "struct O { bool flag; I inner[2]; short word; long long big; "
                                                 "unsigned char last; } x[3];"),
                                    "x")
                               .type;
  EXPECT_EQ(sut.size(), 3 * sizeof(Outer));
  EXPECT_EQ(sut.align, alignof(Outer));
  EXPECT_EQ(sut.fields[1].offset, offsetof(Outer, inner));
  EXPECT_EQ(sut.fields[1].type.element_size, sizeof(Inner));
  EXPECT_EQ(sut.fields[2].offset, offsetof(Outer, word));
  EXPECT_EQ(sut.fields[3].offset, offsetof(Outer, big));
  EXPECT_EQ(sut.fields[4].offset, offsetof(Outer, last));
}

TEST(Types, Char_arrays_are_texts) {
  EXPECT_EQ(type_of("char x[16]"), "text(16)");
  EXPECT_EQ(type_of("char x[3][16]"), "text(16)[3]");
  EXPECT_EQ(type_of("typedef char c; c x[4]"), "text(4)");
  EXPECT_EQ(type_of("typedef char label[8]; label x[2][3]"), "text(8)[2][3]");
  EXPECT_EQ(type_of("char x[] = \"abc\""), "text(4)");
}

TEST(Types, Dimensions_of_a_typedef_come_last) {
  EXPECT_EQ(type_of("typedef int32_t row[3]; row x[2]"), "i32[2][3]");
  EXPECT_EQ(type_of("int32_t x[] = {1, 2, 3}"), "i32[3]");
}

TEST(Types, Anonymous_ones_are_named_after_their_variable) {
  EXPECT_EQ(variable(compile_text("namespace n; struct { int a; } x;"), "n::x").type.name, "n::x_t");
  EXPECT_EQ(variable(compile_text("namespace n; struct { struct { int a; } b; } x;"), "n::x").type.fields[0].type.name,
            "n::x_b_t");
  EXPECT_EQ(variable(compile_text("namespace n; struct { int a; } size;"), "n::size").type.name, "n::size_type")
      << "size_t belongs to the C library";
}

TEST(Kind, Single_numbers_are_atomics) {
  EXPECT_EQ(variable(compile_text("double x;"), "x").kind, abi::Kind::Scalar);
  EXPECT_EQ(variable(compile_text("enum E { A }; E x;"), "x").kind, abi::Kind::Scalar);
  EXPECT_EQ(variable(compile_text("double x[1];"), "x").kind, abi::Kind::Ring);
  EXPECT_EQ(variable(compile_text("char x[2];"), "x").kind, abi::Kind::Ring);
  EXPECT_EQ(variable(compile_text("struct { int8_t a; } x;"), "x").kind, abi::Kind::Ring);
}

TEST(Initial, Values_become_bytes) {
  const auto bytes =
      variable(compile_text("struct P { int16_t a; double b; }; P x[2] = {{1}, {-2, 0.5}};"), "x").initial;
  ASSERT_EQ(bytes.size(), 32U);
  EXPECT_EQ(bytes[0], 1);
  EXPECT_EQ(bytes[16], 0xFE);
  double b = 0;
  std::memcpy(&b, bytes.data() + 24, sizeof b);
  EXPECT_EQ(b, 0.5);
  EXPECT_TRUE(variable(compile_text("int x = 0;"), "x").initial.empty()) << "memory is 0 without it";
  EXPECT_TRUE(variable(compile_text("int x = 0;"), "x").given);
  EXPECT_FALSE(variable(compile_text("int x;"), "x").given);
  EXPECT_TRUE(variable(compile_text("int x = 0;"), "x").is_parameter());
  EXPECT_FALSE(variable(compile_text("int x = 0 @optional;"), "x").is_parameter());
  EXPECT_FALSE(variable(compile_text("int x @optional;"), "x").is_parameter());
  EXPECT_EQ(variable(compile_text("int x @fallback(0);"), "x").fallback.size(), 4U) << "a fallback of 0 is a fallback";
}

TEST(Scopes, Names_are_found_from_the_inside_out) {
  const Compilation sut = compile_text(
      "#define N 2\nnamespace a;\n#define N 3\nnamespace a.b;\nint32_t x[N];\n"
      "namespace c;\nint32_t x[N], y[a::N], z[a.N];");
  EXPECT_EQ(variable(sut, "a::b::x").type.dims[0], 3U);
  EXPECT_EQ(variable(sut, "c::x").type.dims[0], 2U);
  EXPECT_EQ(variable(sut, "c::y").type.dims[0], 3U);
  EXPECT_EQ(variable(sut, "c::z").type.dims[0], 3U);
}

TEST(Scopes, A_namespace_is_not_read_beyond_its_longest_length) {
  std::string path = "namespace n";
  for (int i = 0; i < 60; ++i) {
    path += ".n" + std::to_string(i);
  }
  const std::string found = messages(compile_text(path + ".int;\nint32_t x;"));
  EXPECT_THAT(found, HasSubstr("the namespace is longer than 150 characters, shorten it"));
  EXPECT_THAT(found, Not(HasSubstr("'int'")));
}

TEST(Scopes, A_define_is_known_in_every_namespace) {
  EXPECT_EQ(variable(compile_text("namespace a;\n#define N 3\nnamespace b;\nint32_t x[N];"), "b::x").type.dims[0], 3U);
  EXPECT_THAT(messages(compile_text("namespace a;\n#define N 3\nnamespace c;\n#define N 4\nnamespace b;\nint x[N];")),
              HasSubstr("'N' is not known here"));
  EXPECT_EQ(
      variable(compile_text("namespace a;\n#define N 3\nnamespace b;\n#define N 4\nint x[N];"), "b::x").type.dims[0],
      4U);
}

TEST(Scopes, A_file_sees_only_what_it_includes) {
  const test::Files files{{"a.glb", "include \"b.glb\"\nP p;"},
                          {"b.glb", "include \"c.glb\"\nstruct P { C c; };"},
                          {"c.glb", "struct C { int a; };"},
                          {"d.glb", "P other;"}};
  EXPECT_TRUE(compile_files(files, {"a.glb"}).ok);
  EXPECT_THAT(messages(compile_files(files, {"a.glb", "d.glb"})), HasSubstr("d.glb:1:1: error: there is no type 'P'"));
}

TEST(Includes, A_file_is_read_once) {
  const test::Files files{{"a.glb", "include \"b.glb\"\n#include \"b.glb\"\nint a;"}, {"b.glb", "int b;"}};
  const Compilation sut = compile_files(files, {"a.glb", "b.glb", "a.glb"});
  EXPECT_TRUE(sut.ok) << messages(sut);
  EXPECT_EQ(sut.program.units.size(), 2U);
  EXPECT_EQ(sut.program.units[0].stem, "b") << "before the file that needs it";
  EXPECT_EQ(sut.files.size(), 2U);
}

TEST(Includes, A_cycle_is_an_error) {
  const test::Files files{{"a.glb", "include \"b.glb\"\nint a;"}, {"b.glb", "include \"a.glb\"\nint b;"}};
  EXPECT_THAT(messages(compile_files(files, {"a.glb"})), HasSubstr("includes itself: a.glb -> b.glb -> a.glb"));
  EXPECT_THAT(messages(compile_files({{"a.glb", "include \"a.glb\""}}, {"a.glb"})), HasSubstr("a.glb -> a.glb"));
}

TEST(Includes, Endless_chains_are_errors) {
  int number = 0;
  const auto read = [&](const std::string& path) {
    return ReadResult{"include \"f" + std::to_string(++number) + ".glb\"\n", path, ""};
  };
  EXPECT_THAT(messages(compile({"f.glb"}, read)), HasSubstr("too many files"));
}

TEST(Errors, All_are_shown_at_once_up_to_the_limit) {
  std::string text;
  for (int i = 0; i < 250; ++i) {
    text += "int8_t v" + std::to_string(i) + " = 300;\n";
  }
  const Compilation sut = compile_text(text);
  EXPECT_THAT(messages(sut), HasSubstr("in.glb:100:"));
  EXPECT_THAT(messages(sut), Not(HasSubstr("in.glb:101:")));
  EXPECT_THAT(messages(sut), HasSubstr("too many errors, the first 100 are shown"));
}

TEST(Errors, One_mistake_gives_one_message) {
  const Compilation sut =
      compile_text("struct P { strng name; };\nP p, q[3];\nint a[UNKNOWN];\nconst int N = a b;\nint c[N];");
  const std::string shown = messages(sut);
  EXPECT_EQ(std::count(shown.begin(), shown.end(), '^'), 3) << shown;
}

TEST(Errors, Point_at_the_character_even_behind_tabs_and_umlauts) {
  EXPECT_THAT(
      messages(compile_text("/* \xc3\xa4 */\tint8_t x = 300;")),
      HasSubstr("in.glb:1:20: error: 300 does not fit int8_t (-128 to 127), use a larger type or another value\n"
                "    /* \xc3\xa4 */\tint8_t x = 300;\n"
                "           \t           ^~~\n"));
}

TEST(Errors, Name_types_that_are_the_same_on_all_boards_for_a_char_with_a_sign) {
  for (const char* text : {"char x = -1;", "char x = 200;", "struct S { char c; }; S s = {-5};"}) {
    EXPECT_THAT(messages(compile_text(text)), HasSubstr("does not fit char (0 to 127), use int8_t or uint8_t")) << text;
  }
  EXPECT_EQ(messages(compile_text("char x = 'a'; char y = 127; int8_t z = -1;")), "");
}

TEST(Errors, Show_no_control_characters) {
  EXPECT_THAT(messages(compile_text("int \x1b[31mx;")), Not(HasSubstr("\x1b")));
}

TEST(Limits, Nested_structs_and_many_fields_are_errors) {
  std::string nested;
  for (int i = 0; i < 100; ++i) {
    nested += "struct { ";
  }
  EXPECT_THAT(messages(compile_text(nested)), HasSubstr("levels deep"));

  std::string doubling = "struct S0 { int a; int b; };\n";
  for (int i = 1; i < 30; ++i) {
    const std::string inner = "S" + std::to_string(i - 1);
    doubling += "struct S" + std::to_string(i) + " { " + inner + " a; " + inner + " b; };\n";
  }
  EXPECT_THAT(messages(compile_text(doubling)), HasSubstr("fields"));

  std::string chain = "struct S0 { int a; };\n";
  for (int i = 1; i < 30; ++i) {
    chain += "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a; };\n";
  }
  EXPECT_THAT(messages(compile_text(chain)), HasSubstr("at most 16 deep"));
}

TEST(Limits, Sizes_do_not_overflow) {
  EXPECT_THAT(messages(compile_text("double x[268435456][268435456][268435456][268435456];")),
              HasSubstr("larger than 256 MiB"));
  EXPECT_THAT(messages(compile_text("typedef double a[30000000]; a x[200000000];")), HasSubstr("larger than 256 MiB"));
  EXPECT_THAT(messages(compile_text("int x[4294967297];")), HasSubstr("at most 268435456"));
  EXPECT_TRUE(compile_text("uint8_t x[268435456];").ok);
}

TEST(Limits, Deepest_structs_and_arrays_can_be_read_back_from_the_schema) {
  std::string text = "struct S1 { int8_t a[1][1][1][1][1][1][1][1]; };\n";
  for (int i = 2; i <= 16; ++i) {
    text += "struct S" + std::to_string(i) + " { S" + std::to_string(i - 1) + " a[1][1]; };\n";
  }
  const Compilation sut = compile_text(text + "S16 x[1][1];");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_TRUE(schema::from_json(schema::to_json(schema_of(sut.program.units[0]))).ok());
}

TEST(Functions, Arguments_are_a_struct) {
  const Compilation sut = compile_text("double add(int8_t a, double b) deadline 5ms;");
  const auto& function = std::get<schema::Function>(sut.program.units[0].items[0]);
  EXPECT_EQ(function.arguments.name, "add_args");
  EXPECT_EQ(function.arguments.fields[1].offset, 8U);
  EXPECT_EQ(function.deadline_ns, 5'000'000);
  EXPECT_EQ(function.type_hash, schema::hash_of(function));
}

TEST(Emit, The_hidden_namespace_changes_with_the_content) {
  const Compilation one = compile_text("int x;");
  const Compilation two = compile_text("int x = 1;");
  const auto hidden = [](const Compilation& of) { return emit_cpp(of.program)[0].hidden; };
  EXPECT_NE(hidden(one), hidden(two));
  EXPECT_EQ(hidden(one), hidden(compile_text("int x;")));
  EXPECT_NE(emit_cpp(one.program)[0].text.find("namespace " + hidden(one) + " "), std::string::npos);
}

TEST(Checker, Arrays_of_texts_are_named_because_fastddsgen_misreads_them) {
  const Compilation sut = compile_text(
      "namespace a;\nchar names[3][16];\nstruct S { char labels[2][8]; char one[8]; };\n"
      "S states[2];\nchar single[8];\n");
  ASSERT_TRUE(sut.ok) << messages(sut);
  EXPECT_EQ(
      base::to_text(sut.notes),
      "in.glb: note: fastddsgen 2.3 (Debian 12) makes programs that misread arrays of texts, with all that follows "
      "them: a::names and a::S.labels; for Fast DDS use an array of structs with one text each\n");
  EXPECT_TRUE(compile_text("namespace a;\nchar single[8];\nint32_t n[3];\n").notes.empty());
}

TEST(Checker, A_link_to_a_file_that_is_no_glb_is_not_read) {
  const Compilation sut = compile({"in.glb"}, [](const std::string& path) {
    return path == "in.glb" ? ReadResult{"include \"other.glb\"\n", path, ""}
                            : ReadResult{"topsecret word", "/etc/secret", ""};
  });
  EXPECT_FALSE(sut.ok);
  EXPECT_THAT(messages(sut), HasSubstr("'other.glb' is a link to a file that is not a .glb file"));
  EXPECT_THAT(messages(sut), Not(HasSubstr("topsecret")));
}

}  // namespace
}  // namespace indurop::glb2idl

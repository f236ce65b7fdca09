// SPDX-License-Identifier: Apache-2.0
#include "glb2idl/lexer.h"

#include <gtest/gtest.h>

namespace indurop::glb2idl {
namespace {

struct Result {
  std::vector<std::string> tokens;
  std::vector<std::string> comments;
  std::size_t errors = 0;
};

Result lex(const std::string& text) {
  Sources sources;
  std::vector<base::Diagnostic> found;
  Diagnostics diagnostics(sources, found);
  const auto file = sources.add("in.glb", "in.glb", text);
  const Tokens sut = tokenize(sources, file, diagnostics);
  Result result;
  for (const Token& token : sut.list) {
    if (token.kind != TokenKind::End) {
      result.tokens.push_back((token.newline_before ? "\n" : "") + std::string(token.text));
    }
  }
  for (const Comment& comment : sut.comments) {
    result.comments.push_back(comment.text);
  }
  result.errors = diagnostics.errors();
  return result;
}

using List = std::vector<std::string>;

TEST(Lexer, Splits_words_numbers_and_symbols) {
  EXPECT_EQ(lex("a1+b<<2 ::x").tokens, (List{"\na1", "+", "b", "<<", "2", "::", "x"}));
  EXPECT_EQ(lex("1.5e-3 0x1F 10ms 1'000 .5").tokens, (List{"\n1.5e-3", "0x1F", "10ms", "1'000", ".5"}));
  EXPECT_EQ(lex("1-2 0xe-1").tokens, (List{"\n1", "-", "2", "0xe", "-", "1"}));
}

TEST(Lexer, Keeps_line_breaks_that_a_backslash_does_not_hide) {
  EXPECT_EQ(lex("a\nb").tokens, (List{"\na", "\nb"}));
  EXPECT_EQ(lex("a \\\nb").tokens, (List{"\na", "b"}));
  EXPECT_EQ(lex("a \\\r\nb").tokens, (List{"\na", "b"}));
  EXPECT_EQ(lex("a /* 1\n2 */ b").tokens, (List{"\na", "\nb"}));
}

TEST(Lexer, Cleans_comments) {
  EXPECT_EQ(lex("a // one  two \nb /* x\n * y */ //// z").comments, (List{"one two", "x y", "z"}));
  EXPECT_EQ(lex("//-----\n/******/").comments, (List{"", ""}));
}

TEST(Lexer, Reports_what_is_no_token_and_goes_on) {
  EXPECT_EQ(lex("a $ b").tokens, (List{"\na", "b"}));
  EXPECT_EQ(lex("a $ b").errors, 1U);
  EXPECT_EQ(lex("a \"open\nb").tokens, (List{"\na", "\nb"}));
  EXPECT_EQ(lex("a \"open\nb").errors, 1U);
  EXPECT_EQ(lex("a /* open").errors, 1U);
  EXPECT_EQ(lex(std::string("a\0\0b", 4)).errors, 1U);
}

TEST(Lexer, Reports_other_encodings_once) {
  EXPECT_EQ(lex("// \xb0\xa1 \xb0\xa2\n// \xff\n").errors, 1U);
  EXPECT_EQ(lex("\xff\xfe"
                "a")
                .errors,
            1U);
  EXPECT_EQ(lex("\xef\xbb\xbf"
                "a")
                .tokens,
            (List{"\na"}));
  EXPECT_EQ(lex("// \xc3\xa4").errors, 0U);
  EXPECT_EQ(lex("// \xed\xa0\x80").errors, 1U) << "a surrogate is no UTF-8";
}

}  // namespace
}  // namespace indurop::glb2idl

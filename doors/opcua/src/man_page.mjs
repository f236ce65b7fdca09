// SPDX-License-Identifier: Apache-2.0
// The manual page of a program, from the text of its --help: a line "Usage:", a sentence, and lines of options.

const escaped = (text) => text.replaceAll("\\", "\\e").replaceAll("-", "\\-").replaceAll("'", "\\(aq");

export function man_page(name, help) {
  const lines = help.split("\n");
  const option = /^ {2}(-\S.*?) {2,}(\S.*)$/;
  const sentence = lines.find((line) => line !== "" && !line.startsWith("Usage:")) ?? "";
  const plain = sentence.replaceAll("`", "");
  const page = [
    `.TH ${escaped(name.toUpperCase())} 1 "" "InduRoP" "User Commands"`,
    ".SH NAME", `${escaped(name)} \\- ${escaped(plain.replace(/\.$/u, ""))}`,
    ".SH SYNOPSIS", `\\fB${escaped(name)}\\fR [\\fIoptions\\fR]`,
    ".SH DESCRIPTION", escaped(plain),
    ".SH OPTIONS",
  ];
  for (const line of lines) {
    const found = option.exec(line);
    if (found !== null) page.push(".TP", `\\fB${escaped(found[1])}\\fR`, escaped(found[2].replaceAll("`", "")));
  }
  return `${page.join("\n")}\n`;
}

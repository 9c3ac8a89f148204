// Text that a terminal may be shown.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>

namespace carom {

/// The text with control characters (but for line feeds and tabs) written as \xNN: names and titles come from files,
/// and an escape sequence in one could do anything to the terminal. UTF-8 stays; its control characters U+0080 to
/// U+009F do not.
std::string terminal_text(std::string_view text);

/// True where the stream is a terminal that shows colours, and the environment does not say NO_COLOR
/// (https://no-color.org).
bool shows_colours(std::FILE* stream);

/// The text with the words that its lines begin with coloured: good ones green, doubtful ones yellow, wrong ones red.
std::string with_colours(std::string_view text);

/// Prints the text as terminal_text has it, with colours where the stream shows them.
void print_to_terminal(std::FILE* stream, std::string_view text);

/// The text where it is UTF-8 without control characters; these as ?, and what is no UTF-8 read as Latin-1.
std::string as_utf8(std::string_view text);

/// At most 40 bytes of `text`, in quotes, with control characters and what is no UTF-8 as \xNN.
std::string printable(std::string_view text);

}  // namespace carom

// Text that a terminal may be shown.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// The text with control characters (but for line feeds and tabs) written as \xNN: names and titles come from files,
/// and an escape sequence in one could do anything to the terminal. UTF-8 stays; its control characters U+0080 to
/// U+009F do not.
std::string terminal_text(std::string_view text);

/// At most 40 characters of `text`, in quotes, with unprintable bytes as \xNN.
std::string printable(std::string_view text);

}  // namespace carom

// Files of other programs that are given as a deck or a case: what they seem to be.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// Throws CaseError where the text is empty, has comments of a deck alone, or seems to be a deck of LS-DYNA, Nastran,
/// Radioss or Ansys, at the line that shows it and with what is read instead. Looks at the first 64 KiB.
void refuse_foreign(std::string_view bytes, const std::string& path);

/// Is the keyword in upper case one of LS-DYNA, such as CONTROL_TERMINATION? Those of Abaqus have blanks.
bool is_dyna_keyword(std::string_view name);

}  // namespace carom

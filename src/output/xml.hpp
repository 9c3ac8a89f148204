// Text inside XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace carom {

/// The text with & < > " ' replaced by entities: safe as content and inside quoted attributes of XML and HTML.
std::string xml_escape(std::string_view text);

}  // namespace carom

// Text built into the program for the report page: own style and script, and the curve library (assets.cpp.in).
#pragma once

#include <string_view>

namespace carom::assets {

extern const std::string_view page_css;
extern const std::string_view curves_js;
extern const std::string_view dygraph_js;
extern const std::string_view dygraph_css;
extern const std::string_view dygraph_licence;

}  // namespace carom::assets

// Text built into the program for the report page: own style and scripts, each list of them joined, and the libraries
// (assets.cpp.in).
#pragma once

#include <string_view>

namespace carom::assets {

extern const std::string_view page_css;
extern const std::string_view curves_js;
extern const std::string_view view_js;
extern const std::string_view dygraph_js;
extern const std::string_view dygraph_css;
extern const std::string_view dygraph_licence;
extern const std::string_view three_js;
extern const std::string_view orbit_js;
extern const std::string_view three_licence;

}  // namespace carom::assets

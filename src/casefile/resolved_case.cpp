#include "casefile/resolved_case.hpp"

#include "casefile/case_schema.hpp"
#include "casefile/write_toml.hpp"

namespace carom {

std::string resolved_toml(const Case& given) {
  return write_toml(resolved_tree(given));
}

Node resolved_tree(const Case& given) {
  return case_schema().write(given, nullptr);
}

}  // namespace carom

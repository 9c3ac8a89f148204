// Every pair of scheme and enforcement: the allowed ones are read, the others refused with their reason.
#include "model/compatibility.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>

#include "base/errors.hpp"
#include "casefile/read_case.hpp"
#include "casefile/schema.hpp"

namespace carom::casefile_compatibility_test {
namespace {

std::string case_with(const SchemeTraits& scheme, const std::string& enforcement) {
  return fmt::format(R"(
[[mesh.block]]
size = [1.0, 1.0, 1.0]
divisions = [1, 1, 1]
[materials.unit]
law = "linear_elastic"
E = 1.0
nu = 0.0
rho = 1.0
[[part]]
name = "body"
cells = "BLOCK"
material = "unit"
[scheme]
kind = "{}"
{}
[time]
end = 1.0
step = 0.1
)",
                     scheme.name, enforcement);
}

TEST(Compatibility, EveryPairIsReadOrRefusedWithItsReason) {
  int allowed = 0, refused = 0;
  for (const SchemeTraits& scheme : scheme_table) {
    for (std::size_t e = 0; e < enforcement_count; ++e) {
      SCOPED_TRACE(fmt::format("{} with {}", scheme.name, enforcement_names[e]));
      const std::string text = case_with(scheme, fmt::format("enforcement = \"{}\"", enforcement_names[e]));
      if (scheme.takes[e]) {
        ++allowed;
        const Case read = parse_case(text, "c.toml");
        EXPECT_EQ(*read.scheme.kind, scheme.kind);
        EXPECT_EQ(**read.scheme.enforcement, static_cast<EnforcementKind>(e));
        continue;
      }
      ++refused;
      try {
        parse_case(text, "c.toml");
        ADD_FAILURE() << "was read";
      } catch (const CaseError& error) {
        EXPECT_EQ(error.key(), "scheme.enforcement");
        EXPECT_EQ(error.where().line, 16);
        EXPECT_EQ(error.found(), fmt::format("\"{}\" with the scheme {}", enforcement_names[e], scheme.name));
        EXPECT_NE(std::string(error.what()).find(scheme.why_not), std::string::npos) << error.what();
      }
    }
  }
  EXPECT_GT(allowed, 20);
  EXPECT_GT(refused, 20);
}

TEST(Compatibility, EverySchemeTakesSomethingAndGetsItByDefault) {
  for (const SchemeTraits& scheme : scheme_table) {
    const Case read = parse_case(case_with(scheme, ""), "c.toml");
    EXPECT_TRUE(takes(scheme.kind, **read.scheme.enforcement)) << scheme.name;
    EXPECT_EQ(**read.scheme.enforcement, default_enforcement(scheme.kind));
  }
}

TEST(Compatibility, ThePageInTheRepositoryIsCurrent) {
  std::ifstream file(std::string(CAROM_SOURCE_DIR) + "/docs/compatibility.md");
  const std::string committed{std::istreambuf_iterator<char>(file), {}};
  const std::string written = testing::TempDir() + "compatibility.md";
  if (committed != compatibility_markdown()) std::ofstream(written) << compatibility_markdown();
  EXPECT_TRUE(committed == compatibility_markdown()) << "copy " << written << " to docs/compatibility.md";
}

}  // namespace
}  // namespace carom::casefile_compatibility_test

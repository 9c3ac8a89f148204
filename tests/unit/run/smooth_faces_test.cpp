// Faces that approximate a smooth surface in whole runs: which cases see them so, and the books of an implicit impact.
#include <gtest/gtest.h>

#include <cmath>

#include "run_fixture.hpp"

namespace carom::run_smooth_faces_test {
namespace {

using namespace test;

/// cases/balls/oblique without its checks, `contact` added to its contact.
std::string oblique(const std::string& contact) {
  const std::string folder = std::string(CAROM_SOURCE_DIR) + "/cases/balls/";
  std::string text = replaced(read_text(folder + "oblique.toml"), "balls.msh", folder + "balls.msh");
  text = text.substr(0, text.find("[[check]]"));
  return replaced(text, "kind = \"all\"\n", "kind = \"all\"\n" + contact);
}

std::string key_of_error(const std::string& text) {
  try {
    parse_case(text, "case.toml");
  } catch (const CaseError& e) {
    return e.key();
  }
  return "";
}

/// What the case says or leaves open.
std::optional<bool> smooth_of(const std::string& text) {
  const Case given = parse_case(text, "case.toml");
  const auto& smooth = given.contacts.at(0).surfaces()->smooth;
  return smooth ? std::optional(**smooth) : std::nullopt;
}

const std::string explicit_scheme = "kind = \"central_differences\"";

TEST(SmoothFaces, AreLeftToTheEdgesWithTwoPassAndSpringsAlone) {
  EXPECT_EQ(smooth_of(oblique("")), std::nullopt);
  EXPECT_EQ(smooth_of(oblique("smooth = false\n")), false);
  EXPECT_EQ(smooth_of(oblique("method = \"node_to_surface\"\n")), false);
  EXPECT_EQ(smooth_of(replaced(oblique(""), explicit_scheme, "kind = \"cd_lagrange\"")), false);
}

TEST(SmoothFaces, AreRefusedWhereNothingMakesThem) {
  EXPECT_EQ(key_of_error(oblique("smooth = true\n")), "");
  EXPECT_EQ(key_of_error(oblique("smooth = true\nmethod = \"node_to_surface\"\n")), "contact[0].smooth");
  EXPECT_EQ(key_of_error(oblique("smooth = true\nmethod = \"surface_to_surface\"\n")), "contact[0].smooth");
  EXPECT_EQ(key_of_error(replaced(oblique("smooth = true\n"), explicit_scheme, "kind = \"cd_lagrange\"")),
            "contact[0].smooth");
  EXPECT_EQ(key_of_error(replaced(oblique("smooth = true\n"), explicit_scheme, "kind = \"forward_increment\"")),
            "contact[0].smooth");
}

/// The last line of the ledger of the impact's first ten steps, with friction.
std::map<std::string, double> end_of(const std::string& scheme) {
  const TemporaryCase one(replaced(replaced(oblique("friction = 0.2\n"), explicit_scheme, "kind = \"" + scheme + "\""),
                                   "end = 8.0e-5", "end = 5e-6\nstep = 5e-7"));
  EXPECT_EQ(one.run(), ExitCode::good);
  return last_row(one.result("energy.csv"));
}

// 1e-12 of the energy and of the momenta's scales: sums over some thousand nodes. Newmark's steps keep no angular
// momentum of what turns, contact or not; those of energy_momentum do.
TEST(SmoothFaces, CloseTheBooksOfImplicitSteps) {
  for (const std::string scheme : {"newmark", "energy_momentum"}) {
    const std::map<std::string, double> last = end_of(scheme);
    EXPECT_GT(last.at("contact_stored"), 1e-3 * last.at("kinetic")) << scheme;
    EXPECT_GT(last.at("friction"), 0.0) << scheme;
    EXPECT_LT(std::abs(last.at("imbalance")), 1e-12 * last.at("kinetic")) << scheme;
    EXPECT_LT(last.at("momentum_error"), 1e-12) << scheme;
    if (scheme == "energy_momentum") {
      EXPECT_LT(last.at("angular_momentum_error"), 1e-12);
    }
  }
}

}  // namespace
}  // namespace carom::run_smooth_faces_test

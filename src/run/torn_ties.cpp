#include "run/torn_ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.hpp"
#include "math/vec3.hpp"

namespace carom {

namespace {

void refuse(const Case& given, const ContactGeometry& contact, std::span<const double> x, const std::string& what,
            const std::string& remedy) {
  constexpr double rounding = 1e-9;
  double largest = 0.0;
  for (const double entry : x) largest = std::max(largest, std::abs(entry));
  const ConstraintRows& bonds = contact.bonds();
  for (std::size_t r = 0; r < bonds.size(); ++r) {
    const double parting = norm(bonds.relative(r, x));
    if (parting <= rounding * largest) continue;
    throw CaseError(
        given.contacts[static_cast<std::size_t>(bonds.source[r])].where, "contact",
        fmt::format("initial {} that part what is tied, by {:.4g}: {}", what, parting, contact.describe(bonds, r)),
        "initial values that both sides of a tie share", remedy);
  }
}

}  // namespace

void refuse_torn_ties(const Case& given, const ContactGeometry& contact, std::span<const double> displacement,
                      std::span<const double> velocity) {
  refuse(given, contact, displacement, "displacements", "Give the nodes of both parts the same motion.");
  refuse(given, contact, velocity, "velocities",
         "Give both parts the same velocity. Bodies that come together first and stay so are contact, not a tie.");
}

}  // namespace carom

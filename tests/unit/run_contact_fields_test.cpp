// Contact at the nodes.
#include <gtest/gtest.h>

#include "contact_rows_fixture.hpp"
#include "run/contact_fields.hpp"
#include "run/contact_resultants.hpp"

namespace carom {
namespace {

using namespace test;

// Two flat faces pressed together: whatever the method, the rows' forces of a uniform pressure give that pressure at
// the nodes of both faces.
TEST(NodalContact, HasTheWholePressureOnBothSidesByEveryMethod) {
  constexpr double pressure = 7.0;
  for (const PairMethod method : {PairMethod::node_to_surface, PairMethod::two_pass, PairMethod::surface_to_surface}) {
    Scene scene;
    const auto master = scene.add_patch(4, 4, [](double s, double t) { return Vec3{s, t, 0.0}; });
    const auto slave = scene.add_patch(4, 4, [](double s, double t) { return Vec3{t, s, 0.0}; });
    PairContact contact;
    contact.name = "pair";
    contact.slave = {slave};
    contact.master = {master};
    contact.method = method;
    contact.law.eps_N = 1.0;
    scene.finish().contacts.emplace_back(contact);
    const auto u = scene.zero();
    ContactResponse response;
    response.rows = ContactGeometry(scene.model).rows_at(u, u);
    const double share = method == PairMethod::two_pass ? 0.5 : 1.0;
    for (const double measure : response.rows->measure) {
      response.force.push_back({share * pressure * measure, 0.0, 0.0});
      response.status.push_back(RowStatus::stick);
    }
    const NodalContact nodes = nodal_contact(response, u);
    for (const double p : nodes.pressure) EXPECT_NEAR(p, pressure, 1e-12) << static_cast<int>(method);
    for (const double status : nodes.status) EXPECT_EQ(status, 2.0);
    const ContactResultant sum = ContactResultants(scene.model, {Vec3{}}).of(response, u)[0];
    EXPECT_NEAR(std::abs(sum.force[2]), pressure, 1e-12);  // on unit area: the body of the group has all of it
  }
}

}  // namespace
}  // namespace carom

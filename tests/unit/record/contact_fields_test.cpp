// Contact at the nodes.
#include "record/contact_fields.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

#include "contact_rows_fixture.hpp"
#include "record/contact_resultants.hpp"

namespace carom::run_contact_fields_test {
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
    const NodalContact nodes = nodal_contact(response, u, u);
    EXPECT_EQ(nodes.nodes.size(), scene.model.mesh->node_count()) << "each node of the two patches";
    for (const double p : nodes.pressure) EXPECT_NEAR(p, pressure, 1e-12) << static_cast<int>(method);
    for (const double status : nodes.status) EXPECT_EQ(status, 2.0);
    const ContactResultant sum = ContactResultants(scene.model, {Vec3{}}).of(response, u)[0];
    EXPECT_NEAR(std::abs(sum.force[2]), pressure, 1e-12);  // on unit area: the body of the group has all of it
  }
}

/// Normal forces s of the rows with G^T s = f, the nearest to `start`: conjugate gradients on G G^T s = G f, which may
/// be singular.
std::vector<double> row_forces(const ConstraintRows& rows, const std::vector<double>& f, std::vector<double> start) {
  const std::size_t n = rows.size();
  const auto to_nodes = [&](const std::vector<double>& s) {
    std::vector<double> sum(f.size(), 0.0);
    for (std::size_t r = 0; r < n; ++r) rows.scatter(r, {s[r], 0.0, 0.0}, sum);
    return sum;
  };
  const auto to_rows = [&](const std::vector<double>& nodes) {
    std::vector<double> w(n);
    for (std::size_t r = 0; r < n; ++r) w[r] = rows.relative(r, nodes)[0];
    return w;
  };
  const auto product = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
  };
  std::vector<double> s = std::move(start), rest = f;
  const std::vector<double> first = to_nodes(s);
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] -= first[i];
  std::vector<double> residual = to_rows(rest), way = residual;
  double size = product(residual, residual);
  const double enough = 1e-28 * size;
  for (int k = 0; k < 1000 && size > enough; ++k) {
    const std::vector<double> moved = to_nodes(way), image = to_rows(moved);
    const double length = size / product(way, image);
    for (std::size_t r = 0; r < n; ++r) {
      s[r] += length * way[r];
      residual[r] -= length * image[r];
    }
    const double next = product(residual, residual);
    for (std::size_t r = 0; r < n; ++r) way[r] = residual[r] + next / size * way[r];
    size = next;
  }
  return s;
}

// Faces of 2 x 2 and 5 x 5 facets under a uniform pressure p: the cells of both sides ask for p A_n at each node. Of
// the shares of the two passes that give these forces any may be found; the pressure is p for each of them, where the
// mean of the shares scatters by some tenths.
TEST(NodalContact, IsUniformWhateverTheSharesOfTwoPasses) {
  constexpr double pressure = 7.0;
  Scene scene;
  const auto master = scene.add_patch(2, 2, [](double s, double t) { return Vec3{s, t, 0.0}; });
  const auto slave = scene.add_patch(5, 5, [](double s, double t) { return Vec3{t, s, 0.0}; });
  PairContact contact;
  contact.name = "pair";
  contact.slave = {slave};
  contact.master = {master};
  scene.finish().contacts.emplace_back(contact);
  const auto u = scene.zero();
  ContactResponse response;
  response.rows = ContactGeometry(scene.model).rows_at(u, u);
  const ConstraintRows& rows = *response.rows;
  std::vector<double> wanted = u;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto n = static_cast<std::size_t>(rows.node[static_cast<std::size_t>(rows.begin[r])]);
    wanted[3 * n + 2] = pressure * rows.measure[r] * rows.normal[r][2];
  }
  response.status.assign(rows.size(), RowStatus::stick);
  for (const double size : {0.0, 3.0}) {
    std::vector<double> start;
    for (std::size_t r = 0; r < rows.size(); ++r) start.push_back(size * std::sin(static_cast<double>(r)));
    response.force.clear();
    for (const double s : row_forces(rows, wanted, start)) response.force.push_back({s, 0.0, 0.0});
    const NodalContact nodes = nodal_contact(response, u, u);
    EXPECT_EQ(nodes.nodes.size(), scene.model.mesh->node_count());
    for (const double p : nodes.pressure) EXPECT_NEAR(p, pressure, 1e-10) << size;
  }
}

// The upper patch moves by (3, 4) along the lower one and by 7 away from it: 5 along where they touch, on both sides,
// and nothing where the rows are open.
TEST(NodalContact, SlipsAsFastAsTheSurfacesMoveAlongEachOther) {
  Scene scene;
  const auto master = scene.add_patch(4, 4, [](double s, double t) { return Vec3{s, t, 0.0}; });
  const auto slave = scene.add_patch(4, 4, [](double s, double t) { return Vec3{t, s, 0.0}; });
  PairContact contact;
  contact.name = "pair";
  contact.slave = {slave};
  contact.master = {master};
  scene.finish().contacts.emplace_back(contact);
  const auto u = scene.zero();
  ContactResponse response;
  response.rows = ContactGeometry(scene.model).rows_at(u, u);
  const ConstraintRows& rows = *response.rows;
  std::vector<double> v = u;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const auto n = static_cast<std::size_t>(rows.node[static_cast<std::size_t>(rows.begin[r])]);
    if (rows.is_back[r]) continue;
    for (std::size_t c = 0; c < 3; ++c) v[3 * n + c] = Vec3{3.0, 4.0, 7.0}[c];
  }
  response.force.assign(rows.size(), Vec3{});
  response.status.assign(rows.size(), RowStatus::stick);
  const NodalContact nodes = nodal_contact(response, u, v);
  EXPECT_EQ(nodes.nodes.size(), scene.model.mesh->node_count());
  for (const double rate : nodes.slip_rate) EXPECT_NEAR(rate, 5.0, 1e-12);
  response.status.assign(rows.size(), RowStatus::open);
  for (const double rate : nodal_contact(response, u, v).slip_rate) EXPECT_EQ(rate, 0.0);
}

// The first row guards a node, beside a mean of the other pass: each node has what its own row presses with over its
// area, 3 / 2 and 5 / 4, once.
TEST(NodalContact, CountsGuardsOnceBesideTheMeansOfTwoPasses) {
  auto rows = std::make_shared<ConstraintRows>();
  for (const Index n : {0, 1}) {
    rows->add_row(0.0, {0, 0, 1}, {}, n == 0 ? 2.0 : 4.0, {}, 0);
    rows->add_node(n, 1.0);
  }
  rows->allowed[0] = 0.1;
  rows->is_back[1] = 1;
  ContactResponse response;
  response.rows = rows;
  response.status.assign(2, RowStatus::stick);
  response.force = {{3, 0, 0}, {5, 0, 0}};
  const std::vector<double> u(6, 0.0);
  const NodalContact nodes = nodal_contact(response, u, u);
  EXPECT_EQ(nodes.pressure, (std::vector<double>{1.5, 1.25}));
  EXPECT_EQ(nodes.at_all(nodes.pressure, 3), (std::vector<double>{1.5, 1.25, 0.0})) << "0 where no row stands";
}

}  // namespace
}  // namespace carom::run_contact_fields_test

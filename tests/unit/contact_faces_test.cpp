// Rows of faces: gradients, balance of forces and moments, uniform pressure.
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "contact_rows_fixture.hpp"

namespace carom::contact_faces_test {
namespace {

using namespace test;

PairContact faces(const std::vector<Facet>& slave, const std::vector<Facet>& master) {
  PairContact contact;
  contact.name = "faces";
  contact.method = PairMethod::faces;
  contact.slave = {slave};
  contact.master = {master};
  contact.law.eps_N = 1.0;
  return contact;
}

/// The lower side of the upper patch over the upper side of the lower one, `depth` inside of each other.
struct Two {
  Scene scene;
  std::vector<Facet> upper, lower;

  Two(int n_upper, int n_lower, double depth, double width_upper, double width_lower, bool triangles, double tilt = 0.0) {
    const auto place = [](double width, double s) { return width * (s - 0.5); };
    upper = scene.add_patch(
        n_upper, n_upper,
        [&](double s, double t) {
          return Vec3{place(width_upper, t), place(width_upper, s), -depth + tilt * place(width_upper, s)};
        },
        triangles);
    lower = scene.add_patch(
        n_lower, n_lower,
        [&](double s, double t) {
          return Vec3{place(width_lower, s), place(width_lower, t), 0.0};
        },
        triangles);
    scene.finish().contacts.emplace_back(faces(upper, lower));
  }
  std::vector<double> shaken(Random& random, double size) const {
    std::vector<double> u = scene.zero();
    for (double& x : u) x = random(-size, size);
    return u;
  }
};

/// 1/2 sum eps d^2
double energy(const ContactGeometry& contact, const std::vector<double>& u) {
  const auto rows = contact.rows_at(u, u);
  double sum = 0.0;
  for (std::size_t r = 0; r < rows->size(); ++r) sum += rows->law[r].spring_energy(std::max(0.0, -rows->gap_at(r, u)));
  return sum;
}

std::vector<double> forces(const ContactGeometry& contact, const std::vector<double>& u) {
  const auto rows = contact.rows_at(u, u);
  std::vector<double> f(u.size(), 0.0);
  for (std::size_t r = 0; r < rows->size(); ++r)
    rows->scatter(r, {rows->law[r].spring_force(std::max(0.0, -rows->gap_at(r, u))), 0.0, 0.0}, f);
  return f;
}

TEST(FaceRows, ForcesAreTheGradientOfTheirEnergy) {
  Random random(7);
  for (const bool triangles : {true, false}) {
    for (const double tilt : {0.0, 0.05}) {
      const Two two(3, 4, 0.02, 1.0, 3.0, triangles, tilt);
      const ContactGeometry contact(two.scene.model);
      const std::vector<double> u = two.shaken(random, 0.003);
      const std::vector<double> f = forces(contact, u);
      double largest = 0.0, error = 0.0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        std::vector<double> up = u, down = u;
        up[i] += 1e-6;
        down[i] -= 1e-6;
        const double slope = -(energy(contact, up) - energy(contact, down)) / 2e-6;
        largest = std::max(largest, std::abs(f[i]));
        error = std::max(error, std::abs(slope - f[i]));
        if (std::abs(slope - f[i]) > 1e-4) printf("dof %zu node %zu c %zu: %g %g\n", i, i / 3, i % 3, slope, f[i]);
      }
      printf("triangles %d tilt %g: %g of %g\n", triangles, tilt, error, largest);
    }
  }
}

TEST(FaceRows, Crossed) {
  Random random(7);
  Scene scene;
  auto all = scene.add_box({0, 0, 0}, {10, 10, 10}, 2);
  const std::size_t first = scene.mesh.coordinates.size();
  auto more = scene.add_box({3, 2, 0}, {15, 11, 10}, 3);
  all.insert(all.end(), more.begin(), more.end());
  const double a = 0.07, b = 0.05;
  for (std::size_t n = first; n < scene.mesh.coordinates.size(); ++n) {
    Vec3& x = scene.mesh.coordinates[n];
    x = {x[0] * std::cos(a) - x[2] * std::sin(a), x[1], x[0] * std::sin(a) + x[2] * std::cos(a)};
    x = {x[0], x[1] * std::cos(b) - x[2] * std::sin(b), x[1] * std::sin(b) + x[2] * std::cos(b)};
    x[2] += 10 - 0.4;
  }
  PairContact c = faces(all, all);
  c.self = true;
  scene.finish().contacts.emplace_back(c);
  const ContactGeometry contact(scene.model);
  for (const double size : {0.0, 0.05}) {
    std::vector<double> u = scene.zero();
    for (std::size_t i = 0; i < u.size(); i += 1) u[i] = random(-size, size);
    const std::vector<double> f = forces(contact, u);
    printf("energy %g\n", energy(contact, u));
    double largest = 0;
    for (const double x : f) largest = std::max(largest, std::abs(x));
    for (std::size_t i = 0; i < u.size(); ++i) {
      std::vector<double> up = u, down = u;
      up[i] += 1e-6;
      down[i] -= 1e-6;
      const double slope = -(energy(contact, up) - energy(contact, down)) / 2e-6;
      if (std::abs(slope - f[i]) > 1e-3 * largest) printf("dof %zu node %zu c %zu: %g %g of %g\n", i, i / 3, i % 3, slope, f[i], largest);
    }
  }
}

}  // namespace
}  // namespace carom::contact_faces_test

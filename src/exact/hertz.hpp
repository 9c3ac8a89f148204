// Hertz's theory of the contact of smooth elastic bodies, at rest and in impact.
#pragma once

namespace carom {

/// E*: 1/E* = (1 - nu_1^2) / E_1 + (1 - nu_2^2) / E_2 (Johnson, Contact Mechanics, 1985, section 4.2). Infinity stands
/// for a rigid body. Throws std::invalid_argument when a modulus is not positive, nu is outside (-1, 0.5], or both
/// bodies are rigid.
double hertz_modulus(double modulus_1, double nu_1, double modulus_2, double nu_2);

/// a b / (a + b): radius R of two bodies, 1/R = 1/R_1 + 1/R_2, and mass of two bodies that meet. Infinity stands for a
/// plane, or for a body that does not move. Throws std::invalid_argument when one is not positive or both are infinite.
double hertz_combination(double a, double b);

/// Two spheres, or a sphere on a plane, at rest: radius R and modulus E* combined. Equation numbers are Johnson's.
class HertzSphere {
 public:
  /// Throws std::invalid_argument when a number is not positive.
  HertzSphere(double radius, double modulus);

  /// P = 4/3 E* R^(1/2) delta^(3/2), delta >= 0 the approach of distant points (4.23).
  double force(double approach) const;
  /// delta = a^2 / R = (9 P^2 / (16 R E*^2))^(1/3), P >= 0 (4.23).
  double approach(double force) const;
  /// a = (3 P R / (4 E*))^(1/3) (4.22).
  double contact_radius(double force) const;
  /// p_0 = 3 P / (2 pi a^2) = (6 P E*^2 / (pi^3 R^2))^(1/3) (4.24).
  double peak_pressure(double force) const;
  /// p = p_0 (1 - (r/a)^2)^(1/2), 0 outside the contact (section 4.2).
  double pressure(double force, double r) const;
  /// Work to press them together: 8/15 E* R^(1/2) delta^(5/2).
  double energy(double approach) const;

 private:
  double radius_, modulus_;
};

/// Two parallel cylinders, or a cylinder on a plane, at rest: radius R and modulus E* combined, forces per length. The
/// approach is not determined by the theory of the contact alone.
class HertzCylinder {
 public:
  /// Throws std::invalid_argument when a number is not positive.
  HertzCylinder(double radius, double modulus);

  /// a = (4 P R / (pi E*))^(1/2) (4.43).
  double half_width(double force) const;
  /// p_0 = 2 P / (pi a) = (P E* / (pi R))^(1/2) (4.45).
  double peak_pressure(double force) const;
  /// p = p_0 (1 - (x/a)^2)^(1/2), 0 outside the contact (4.44).
  double pressure(double force, double x) const;

 private:
  double radius_, modulus_;
};

/// Two spheres meet head-on, or one meets a wall, slowly against the wave speed, so that the contact is that of bodies
/// at rest at every time (Johnson, section 11.4):
///   m delta'' = -P(delta),  delta(0) = 0,  delta'(0) = V,  m, R and E* combined.
/// With delta = delta_max sin(theta)^(4/5), 0 <= theta <= pi, the energy gives delta' = V cos(theta) and
///   V t / delta_max = 4/5 integral of sin^(-1/5) from 0 to theta,
/// which is integrated term by term as a power series in theta^2, to rounding.
class HertzImpact {
 public:
  /// speed: V > 0 of the approach. Throws std::invalid_argument when a number is not positive.
  HertzImpact(double mass, double radius, double modulus, double speed);

  /// delta_max = (15 m V^2 / (16 R^(1/2) E*))^(2/5)
  double peak_approach() const { return peak_approach_; }
  double peak_force() const { return sphere_.force(peak_approach_); }
  double peak_pressure() const { return sphere_.peak_pressure(peak_force()); }
  /// k delta_max / V, k = 4 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10)) = 2.94327518...
  double contact_time() const;

  /// t from the first touch; after the contact the bodies part at V and the approach is 0.
  double approach(double t) const;
  double speed(double t) const;
  double force(double t) const { return sphere_.force(approach(t)); }

 private:
  double phase(double t) const;

  HertzSphere sphere_;
  double speed_, peak_approach_;
};

}  // namespace carom

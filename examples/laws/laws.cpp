// Two laws for Carom in a library: those that the program has as "neo_hookean" and, with linear hardening,
// "j2_small_strain". With the instruction set of the program and its flags they give its bits. docs/user_laws.md has
// the command that makes the library.
//
// All lanes of a point are computed at once, in vector types of GCC and Clang: what is written for one number holds for
// the lanes. Plain loops over lanes do as well.
#include <math.h>

#include <limits>

#include "carom_law.h"

namespace {

using Lanes2 = double __attribute__((vector_size(16)));
using Lanes4 = double __attribute__((vector_size(32)));
using Lanes8 = double __attribute__((vector_size(64)));

template <class Real>
constexpr int lanes = static_cast<int>(sizeof(Real) / sizeof(double));

template <class Real>
struct Unaligned {
  using Type [[gnu::aligned(8), gnu::may_alias]] = Real;
};
template <class Real>
Real load(const double* p) {
  return *reinterpret_cast<const typename Unaligned<Real>::Type*>(p);
}
template <class Real>
void store(double* p, const Real& r) {
  *reinterpret_cast<typename Unaligned<Real>::Type*>(p) = r;
}

template <class Real>
Real square_root(const Real& r) {
  double lane[lanes<Real>];
  store(lane, r);
  for (double& x : lane) x = __builtin_sqrt(x);
  return load<Real>(lane);
}
template <class Real>
bool any_above(const Real& r, double limit) {
  double lane[lanes<Real>];
  store(lane, r);
  bool above = false;
  for (const double x : lane) above = above || !(x <= limit);
  return above;
}

struct Lame {
  double lambda, G;
};
Lame lame(const double* parameters) {
  const double E = parameters[0], nu = parameters[1];
  return {E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu))};
}

void at_rest(const double* parameters, double* E, double* nu) {
  *E = parameters[0];
  *nu = parameters[1];
}

// ---- neo-Hookean: W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2, S = G (1 - C^-1) + lambda ln J C^-1, C = 1 + 2 E.

// c[0] + c[1] x + ... by Estrin's scheme.
template <class Real, int n>
Real polynomial(const double (&c)[n], Real x) {
  Real term[(n + 1) / 2];
  for (int i = 0; i < n / 2; ++i) term[i] = c[2 * i] + c[2 * i + 1] * x;
  if (n % 2 == 1) term[n / 2] = Real{} + c[n - 1];
  for (int left = (n + 1) / 2; left > 1; left = (left + 1) / 2) {
    x = x * x;
    for (int i = 0; i < left / 2; ++i) term[i] = term[2 * i] + x * term[2 * i + 1];
    if (left % 2 == 1) term[left / 2] = term[left - 1];
  }
  return term[0];
}

// ln(1 + f) = 2 s + tail, s = f / (2 + f), and f - ln(1 + f), for f between -1/3 and 1/2.
template <class Real>
void near_logarithm(const Real& f, Real& log, Real& rest) {
  constexpr double odd[] = {1.0 / 3,  1.0 / 5,  1.0 / 7,  1.0 / 9,  1.0 / 11,
                            1.0 / 13, 1.0 / 15, 1.0 / 17, 1.0 / 19, 1.0 / 21};
  const Real s = f / (2.0 + f), t = s * s, tail = (2.0 * s * t) * polynomial(odd, t);
  log = 2.0 * s + tail;
  rest = f * s - tail;
}

// ln(1 + q) and q - ln(1 + q); lanes whose body is compressed or stretched far are 1 + q = m 2^e, m around 1.
template <class Real>
void logarithm(const Real& q, Real& log, Real& rest) {
  constexpr double least = -1.0 / 3.0, largest = 0.5;
  constexpr double ln2_high = 6.93147180369123816490e-01, ln2_low = 1.90821492927058770002e-10;
  if (!any_above(q, largest) && !any_above(Real(-q), -least)) return near_logarithm(q, log, rest);
  double y[lanes<Real>], m[lanes<Real>], e[lanes<Real>], of_q[lanes<Real>];
  store(of_q, q);
  store(y, Real(1.0 + q));
  for (int l = 0; l < lanes<Real>; ++l) {
    int exponent = 0;
    m[l] = y[l] > 0.0 ? frexp(y[l], &exponent) : 1.0;  // between 1/2 and 1
    if (m[l] < 0x1.6a09e667f3bcdp-1) {                 // the square root of 1/2
      m[l] *= 2.0;
      --exponent;
    }
    e[l] = exponent;
    if (!(of_q[l] > largest || of_q[l] < least)) m[l] = std::numeric_limits<double>::quiet_NaN();  // near
  }
  const Real far_m = load<Real>(m), far_e = load<Real>(e);
  const Real nothing = Real{} + std::numeric_limits<double>::quiet_NaN(), one = Real{} + 1.0;
  const Real is_far = far_m == far_m ? one : Real{};
  near_logarithm(Real(is_far > 0.0 ? far_m - 1.0 : q), log, rest);
  const Real far = far_e * ln2_high + (log + far_e * ln2_low);
  log = is_far > 0.0 ? (1.0 + q > 0.0 ? far : nothing) : log;
  rest = is_far > 0.0 ? q - log : rest;
}

// C^-1 = adjugate / (1 + q) with the invariants of the strain e kept apart: nothing cancels where it is small.
template <class Real>
struct Cauchy {
  Real q, adjugate[6], diagonal[3], second_and_third;
};
template <class Real>
Cauchy<Real> right_cauchy_green(const Real e[6]) {
  Cauchy<Real> C;
  const Real xy = e[3] * e[3], yz = e[4] * e[4], zx = e[5] * e[5];
  const Real I_2 = e[0] * e[1] + e[1] * e[2] + e[2] * e[0] - 0.25 * (xy + yz + zx);
  const Real I_3 = e[0] * e[1] * e[2] + 0.25 * (e[3] * e[4] * e[5] - e[0] * yz - e[1] * zx - e[2] * xy);
  C.second_and_third = 4.0 * I_2 + 8.0 * I_3;
  C.q = 2.0 * (e[0] + e[1] + e[2]) + C.second_and_third;
  const Real minors[3] = {2.0 * (e[1] + e[2]) + 4.0 * e[1] * e[2] - yz, 2.0 * (e[2] + e[0]) + 4.0 * e[2] * e[0] - zx,
                          2.0 * (e[0] + e[1]) + 4.0 * e[0] * e[1] - xy};
  for (int c = 0; c < 3; ++c) {
    C.adjugate[c] = 1.0 + minors[c];
    C.diagonal[c] = C.q - minors[c];
  }
  C.adjugate[3] = e[4] * e[5] - e[3] * (1.0 + 2.0 * e[2]);
  C.adjugate[4] = e[5] * e[3] - e[4] * (1.0 + 2.0 * e[0]);
  C.adjugate[5] = e[3] * e[4] - e[5] * (1.0 + 2.0 * e[1]);
  return C;
}

// At least the largest principal value of e: mean + sqrt(2/3) |deviator|.
template <class Real>
Real largest_principal_bound(const Real e[6]) {
  const Real mean = (e[0] + e[1] + e[2]) * (1.0 / 3.0);
  Real square = 0.5 * (e[3] * e[3] + e[4] * e[4] + e[5] * e[5]);
  for (int c = 0; c < 3; ++c) square += (e[c] - mean) * (e[c] - mean);
  return mean + square_root(Real(square * (2.0 / 3.0)));
}

template <class Real>
void neo_update(const carom_law_points& b) {
  const auto [lambda, G] = lame(b.parameters);
  constexpr int n = lanes<Real>;
  for (int p = 0; p < b.points; ++p) {
    double* stress = b.stress + 6 * p * n;
    Real e[6], log, rest;
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(b.strain + (6 * p + c) * n);
    const auto C = right_cauchy_green(e);
    logarithm(C.q, log, rest);
    const Real ln_J = 0.5 * log, inverse = 1.0 / (1.0 + C.q), volumetric = lambda * ln_J;
    for (int c = 0; c < 3; ++c) store(stress + c * n, Real((G * C.diagonal[c] + volumetric * C.adjugate[c]) * inverse));
    for (int c = 3; c < 6; ++c) store(stress + c * n, Real((volumetric - G) * C.adjugate[c] * inverse));
    if (b.energy != nullptr)
      store(b.energy + p * n, Real(0.5 * G * (rest - C.second_and_third) + 0.5 * volumetric * ln_J));
    if (b.wave_modulus != nullptr) {
      const Real pressure = (lambda + G) - volumetric, zero = Real{};
      store(b.wave_modulus + p * n,
            Real(G + 2.0 * G * largest_principal_bound(e) + (pressure > 0.0 ? pressure : zero)));
    }
  }
}

template <class Real>
void neo_tangent(const carom_law_changes& b) {
  const auto [lambda, G] = lame(b.parameters);
  constexpr int n = lanes<Real>;
  constexpr int voigt[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (int p = 0; p < b.points; ++p) {
    Real e[6], d[6], log, rest;
    for (int c = 0; c < 6; ++c) e[c] = load<Real>(b.strain + (6 * p + c) * n);
    for (int c = 0; c < 6; ++c) d[c] = load<Real>(b.strain_change + (6 * p + c) * n);
    const auto C = right_cauchy_green(e);
    logarithm(C.q, log, rest);
    const Real inverse = 1.0 / (1.0 + C.q), shear = 2.0 * G - lambda * log;
    Real c_inverse[6], product[3][3];  // product = C^-1 dE
    for (int c = 0; c < 6; ++c) c_inverse[c] = inverse * C.adjugate[c];
    for (int c = 3; c < 6; ++c) d[c] *= 0.5;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        product[i][j] = c_inverse[voigt[i][0]] * d[voigt[0][j]] + c_inverse[voigt[i][1]] * d[voigt[1][j]] +
                        c_inverse[voigt[i][2]] * d[voigt[2][j]];
    const Real volumetric = lambda * (product[0][0] + product[1][1] + product[2][2]);
    for (int c = 0; c < 6; ++c) {
      const int i = pair[c][0], j = pair[c][1];
      const Real sandwich = product[i][0] * c_inverse[voigt[0][j]] + product[i][1] * c_inverse[voigt[1][j]] +
                            product[i][2] * c_inverse[voigt[2][j]];
      store(b.stress_change + (6 * p + c) * n, Real(shear * sandwich + volumetric * c_inverse[c]));
    }
  }
}

// ---- von Mises plasticity with sigma_y = yield_stress + hardening_modulus alpha at small strain, by radial return.
// History: the plastic strain (the tensor's components), alpha.

struct Metal {
  double G, K, lambda, yield, hardening;
};
Metal metal(const double* parameters) {
  const auto [lambda, G] = lame(parameters);
  return {G, lambda + 2.0 / 3.0 * G, lambda, parameters[2], parameters[3]};
}

// The deviator of the elastic trial strain, without what cancels in its trace, and the equivalent stress there.
template <class Real>
struct Trial {
  Real deviator[6], trace, stress;
};
template <class Real>
Trial<Real> trial_of(double G, const double* strain, const double* history) {
  constexpr int n = lanes<Real>;
  Trial<Real> trial;
  Real e[6];
  for (int c = 0; c < 6; ++c) {
    e[c] = load<Real>(strain + c * n);
    e[c] -= (c < 3 ? 1.0 : 2.0) * load<Real>(history + c * n);
  }
  trial.trace = e[0] + e[1] + e[2];
  const Real xy = e[0] - e[1], yz = e[1] - e[2], zx = e[2] - e[0];
  trial.deviator[0] = (xy - zx) * (1.0 / 3.0);
  trial.deviator[1] = (yz - xy) * (1.0 / 3.0);
  trial.deviator[2] = (zx - yz) * (1.0 / 3.0);
  Real square = Real{};
  for (int c = 3; c < 6; ++c) trial.deviator[c] = 0.5 * e[c];
  for (int c = 0; c < 6; ++c) square += (c < 3 ? 1.0 : 2.0) * trial.deviator[c] * trial.deviator[c];
  trial.stress = G * square_root(Real(6.0 * square));
  return trial;
}

// The stress is `share` of the trial one; its changes along the trial deviator are `slope` times those of that.
template <class Real>
struct Return {
  Real share, slope, alpha;
};
template <class Real>
Return<Real> radial_return(const Metal& law, const Real& trial, const Real& alpha, bool is_over) {
  const Real zero{}, one = zero + 1.0;
  Return<Real> end{one, one, alpha};
  if (is_over || !any_above(trial, law.yield)) return end;
  const double three_G = 3.0 * law.G;
  const Real excess = trial - (law.yield + law.hardening * alpha), hardening = zero + law.hardening;
  const Real increment = excess * (1.0 / (three_G + law.hardening));
  const Real left = 1.0 - three_G * increment / trial;
  end.share = excess > 0.0 ? (left > 0.0 ? left : zero) : one;
  end.slope = excess > 0.0 ? hardening / (three_G + hardening) : one;
  end.alpha += excess > 0.0 ? increment : zero;
  return end;
}

// Hourglass modes of stabilised cells raise the trial stress, and flow with the point.
template <class Real>
Real with_modes(const Real& trial, const double* mode_square, int p) {
  if (mode_square == nullptr) return trial;
  return square_root(Real(trial * trial + load<Real>(mode_square + p * lanes<Real>)));
}

template <class Real>
void j2_update(const carom_law_points& b) {
  const Metal law = metal(b.parameters);
  constexpr int n = lanes<Real>, H = 7 * n;
  for (int p = 0; p < b.points; ++p) {
    const double* history = b.history + H * p;
    const Trial<Real> trial = trial_of<Real>(law.G, b.strain + 6 * p * n, history);
    const Real alpha = load<Real>(history + 6 * n);
    if (b.yield_stress != nullptr) store(b.yield_stress + p * n, Real(law.yield + law.hardening * alpha));
    const Return<Real> end = radial_return(law, with_modes(trial.stress, b.mode_square, p), alpha, b.is_over != 0);
    if (b.share != nullptr) store(b.share + p * n, end.share);
    const Real pressure_part = law.K * trial.trace, modulus = 2.0 * law.G * end.share;
    double* stress = b.stress + 6 * p * n;
    for (int c = 0; c < 3; ++c) store(stress + c * n, Real(pressure_part + modulus * trial.deviator[c]));
    for (int c = 3; c < 6; ++c) store(stress + c * n, Real(modulus * trial.deviator[c]));
    if (b.energy != nullptr) {
      const Real equivalent = end.share * trial.stress;
      store(b.energy + p * n,
            Real(0.5 * pressure_part * trial.trace + equivalent * equivalent * (1.0 / (6.0 * law.G))));
    }
    if (b.new_history != nullptr) {
      double* changed = b.new_history + H * p;
      for (int c = 0; c < 6; ++c)
        store(changed + c * n, Real(load<Real>(history + c * n) + (1.0 - end.share) * trial.deviator[c]));
      store(changed + 6 * n, end.alpha);
    }
    if (b.dissipation != nullptr)
      store(b.dissipation + p * n, Real((law.yield + 0.5 * law.hardening * end.alpha) * end.alpha));
    if (b.wave_modulus != nullptr) store(b.wave_modulus + p * n, Real(Real{} + (law.lambda + 2.0 * law.G)));
  }
}

template <class Real>
void j2_tangent(const carom_law_changes& b) {
  const Metal law = metal(b.parameters);
  constexpr int n = lanes<Real>, H = 7 * n;
  const Real zero{}, one = zero + 1.0;
  for (int p = 0; p < b.points; ++p) {
    const double* history = b.history + H * p;
    const Trial<Real> trial = trial_of<Real>(law.G, b.strain + 6 * p * n, history);
    const Return<Real> end =
        radial_return(law, with_modes(trial.stress, b.mode_square, p), load<Real>(history + 6 * n), false);
    Real d[6], square = zero, product = zero;
    for (int c = 0; c < 6; ++c) d[c] = (c < 3 ? 1.0 : 0.5) * load<Real>(b.strain_change + (6 * p + c) * n);
    const Real trace = d[0] + d[1] + d[2];
    for (int c = 0; c < 6; ++c) {
      const double weight = c < 3 ? 1.0 : 2.0;
      square += weight * trial.deviator[c] * trial.deviator[c];
      product += weight * trial.deviator[c] * d[c];
    }
    if (b.mode_square != nullptr) {
      const double scale = 1.0 / (6.0 * law.G * law.G);
      square += scale * load<Real>(b.mode_square + p * n);
      product += scale * load<Real>(b.half_change + p * n);
    }
    const Real along = square > 0.0 ? (end.slope - end.share) * product / (square > 0.0 ? square : one) : zero;
    if (b.share != nullptr) {
      store(b.share + p * n, end.share);
      store(b.along + p * n, along);
    }
    for (int c = 0; c < 6; ++c) {
      const Real deviator = c < 3 ? d[c] - trace * (1.0 / 3.0) : d[c];
      const Real change = 2.0 * law.G * (end.share * deviator + along * trial.deviator[c]);
      store(b.stress_change + (6 * p + c) * n, Real(c < 3 ? law.K * trace + change : change));
    }
  }
}

// ---- one function for all numbers of lanes, and the table

#define FOR_LANES(function, Batch)           \
  void function##_of_lanes(const Batch* b) { \
    switch (b->lanes) {                      \
      case 2:                                \
        return function<Lanes2>(*b);         \
      case 4:                                \
        return function<Lanes4>(*b);         \
      case 8:                                \
        return function<Lanes8>(*b);         \
      default:                               \
        return function<double>(*b);         \
    }                                        \
  }
FOR_LANES(neo_update, carom_law_points)
FOR_LANES(neo_tangent, carom_law_changes)
FOR_LANES(j2_update, carom_law_points)
FOR_LANES(j2_tangent, carom_law_changes)

const carom_law_parameter parameters[] = {
    {"E", "Young's modulus.", "stress", 0.0, INFINITY, 0, 0, NAN},
    {"nu", "Poisson's ratio.", "", -1.0, 0.5, 0, 0, NAN},
    {"yield_stress", "First yield stress in tension.", "stress", 0.0, INFINITY, 0, 0, NAN},
    {"hardening_modulus", "Slope of the yield stress over the plastic strain.", "stress", 0.0, INFINITY, 1, 0, 0.0}};

const char* const history[] = {"plastic_strain_xx",        "plastic_strain_yy", "plastic_strain_zz",
                               "plastic_strain_xy",        "plastic_strain_yz", "plastic_strain_zx",
                               "equivalent_plastic_strain"};

const carom_law laws[] = {
    {"neo", "the compressible neo-Hookean law", "W = G/2 (tr C - 3) - G ln J + lambda/2 (ln J)^2", CAROM_GREEN_LAGRANGE,
     2, parameters, 0, nullptr, at_rest, nullptr, neo_update_of_lanes, neo_tangent_of_lanes},
    {"metal", "von Mises plasticity with linear hardening, for small strains",
     "sigma_y = yield_stress + hardening_modulus alpha", CAROM_SMALL_STRAIN, 4, parameters, 7, history, at_rest,
     nullptr, j2_update_of_lanes, j2_tangent_of_lanes}};

}  // namespace

extern "C" const carom_law_library* carom_laws() {
  static const carom_law_library library = {CAROM_LAW_INTERFACE, "1.0", 2, laws};
  return &library;
}

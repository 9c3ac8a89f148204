// What a record of accelerations does to what it shakes: head injury criterion, pulse, shock response spectrum.
#pragma once

#include <array>
#include <span>
#include <vector>

namespace carom {

/// A value over an interval of the record; times in seconds from its first sample.
struct HeadInjury {
  double value = 0.0, begin = 0.0, end = 0.0;
};

/// HIC = max over t1 < t2 <= t1 + window of (t2 - t1) [1 / (t2 - t1) integral of a dt from t1 to t2]^2.5, a in g, times
/// in seconds (J. Versace, A review of the severity index, SAE 710881, 1971; FMVSS 208, 49 CFR 571.208, with windows of
/// 15 ms and 36 ms). a: the resultant, not negative, `dt` apart, integrated by the trapezoidal rule; t1 and
/// t2 are samples. Zero of fewer than two.
HeadInjury head_injury_criterion(std::span<const double> a, double dt, double window);

/// The pulse with the largest acceleration of a record. It is looked at along the direction that the acceleration has
/// at that peak, and lasts as long as the component along it stays above a tenth of the peak (ISO 2041, duration of a
/// shock pulse, with the fraction that is usual for measured ones). Times in seconds from the first sample, linear
/// between samples.
struct ShockPulse {
  double peak = 0.0, time = 0.0;  ///< of the resultant
  double begin = 0.0, end = 0.0;  ///< where the component crosses a tenth of the peak, or the record's ends
  /// Integral of the component from where it is zero before the peak to where it is after.
  double velocity_change = 0.0;
};
ShockPulse shock_pulse(const std::array<std::vector<double>, 3>& a, double dt);

/// Maximax absolute acceleration of oscillators of one degree of freedom on a base that has the acceleration a, linear
/// between samples dt apart, from rest; after the record the base has none (the residual counts). For each natural
/// frequency f, with the ratio of damping 1 / (2 Q):
///   A = w dt / (2 Q), B = w dt sqrt(1 - 1 / (4 Q^2)), w = 2 pi f,
///   y_k = b0 x_k + b1 x_(k-1) + b2 x_(k-2) + 2 e^-A cos(B) y_(k-1) - e^-2A y_(k-2),
///   b0 = 1 - e^-A sin(B) / B, b1 = 2 e^-A (sin(B) / B - cos(B)), b2 = e^-2A - e^-A sin(B) / B
/// (D. O. Smallwood, An improved recursive formula for calculating shock response spectra, Shock and Vibration Bulletin
/// 51, 1981; ISO 18431-4). The largest is that of the samples: 1.3 % low at most where there are 20 to a period.
std::vector<double> shock_response_spectrum(std::span<const double> a, double dt, std::span<const double> frequencies,
                                            double quality_factor);

/// Twelve to an octave, from a tenth of the reciprocal of the record's duration to `highest`; 2^(k / 12) Hz.
std::vector<double> spectrum_frequencies(double duration, double highest);

}  // namespace carom

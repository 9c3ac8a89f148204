// Units as a reader writes them: kN rather than 10^3 N.
#pragma once

#include <string>

namespace carom {

/// The number with so many digits, or a dash for NaN.
std::string number_text(double value, int digits);

/// A unit and the power of ten that it stands for: a number in the unit given is shown divided by 10^power.
struct ReadableUnit {
  int power = 0;
  std::string name;
};

/// For numbers of up to `largest` (magnitude) in `unit`: a multiple of three as power, so that the largest lies between
/// 1 and 1000 or is close to it, and the SI prefix that belongs to it ("mm/s" and 3 give "m/s", "MPa" and 3 "GPa").
/// Numbers from 0.1 to 1000 stay as they are. Units that take no prefix are named with the power ("10⁶ kg m/s") from
/// 10000 on.
ReadableUnit readable_unit(double largest, const std::string& unit);

/// The number in its readable unit, e.g. "40.7 kN"; a dash for NaN.
std::string with_readable_unit(double value, const std::string& unit, int digits);

}  // namespace carom

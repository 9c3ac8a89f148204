// Formulas in the coordinates, written by users.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>

#include "base/types.hpp"

namespace carom {

/// The text is no formula in x, y and z; what() says where it goes wrong.
class ExpressionError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A formula such as "-8000 * y * z": numbers, x, y, z, pi, + - * / ^, comparisons with ?: and the usual functions
/// (sin, cos, sqrt, exp, ln, abs, min, max, ...). It computes a number and can do nothing else.
class Expression {
 public:
  /// Throws ExpressionError.
  explicit Expression(const std::string& text);
  ~Expression();
  Expression(Expression&&) noexcept;
  Expression& operator=(Expression&&) noexcept;

  /// Its value at x; may not be finite (1 / 0, sqrt(-1)). Not for two threads at once.
  double at(const Vec3& x) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace carom

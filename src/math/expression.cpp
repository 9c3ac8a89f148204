#include "math/expression.hpp"

#include <muParser.h>

#include <numbers>

namespace carom {

struct Expression::Parser {
  Vec3 x{};
  mu::Parser mu;
};

namespace {

/// muParser gives some errors a position, the others -1.
std::string description(const mu::ParserError& e) {
  const bool is_placed = e.GetPos() >= 0 && static_cast<std::size_t>(e.GetPos()) <= e.GetExpr().size();
  const std::string at = is_placed ? " (character " + std::to_string(e.GetPos() + 1) + ")" : "";
  return e.GetMsg() + at;
}

/// The parser takes a single = as the assignment of a variable.
void refuse_assignment(const std::string& text) {
  for (std::size_t k = text.find('='); k != std::string::npos; k = text.find('=', k + 1)) {
    const bool is_second = k > 0 && std::string_view("=<>!").find(text[k - 1]) != std::string_view::npos;
    if (!is_second && text.compare(k, 2, "==") != 0)
      throw ExpressionError("= compares nothing (character " + std::to_string(k + 1) +
                            "): comparisons are ==, !=, <, <=, >, >=");
  }
}

}  // namespace

Expression::Expression(const std::string& text) : parser_(std::make_unique<Parser>()) {
  mu::Parser& mu = parser_->mu;
  refuse_assignment(text);
  try {
    mu.ClearConst();
    mu.DefineConst("pi", std::numbers::pi);
    const char* names[] = {"x", "y", "z"};
    for (std::size_t c = 0; c < 3; ++c) mu.DefineVar(names[c], &parser_->x[c]);
    mu.SetExpr(text);
    mu.Eval();
    if (mu.GetNumResults() != 1) throw ExpressionError("commas separate several formulas; one is wanted");
  } catch (const mu::ParserError& e) {
    throw ExpressionError(description(e));
  }
}

Expression::~Expression() = default;
Expression::Expression(Expression&&) noexcept = default;
Expression& Expression::operator=(Expression&&) noexcept = default;

double Expression::at(const Vec3& x) const {
  parser_->x = x;
  return parser_->mu.Eval();
}

}  // namespace carom

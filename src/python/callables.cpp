#include "python/callables.hpp"

#include <fmt/format.h>
#include <pybind11/numpy.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

namespace carom::python {

namespace {

std::atomic<bool> is_put_off{false};

void put_off_interrupt() {
  is_put_off.store(true);
  PyErr_SetInterrupt();
}

/// A callable of Python that may be called, and dropped, by any thread.
class Held {
 public:
  Held(std::string name, py::object callable) : name_(std::move(name)), callable_(std::move(callable)) {}
  ~Held() {
    const py::gil_scoped_acquire acquire;
    callable_ = py::object();
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  /// What `take` makes of what `call` gives, which is called with the callable. With the lock of the interpreter.
  template <class Call, class Take>
  auto ask(const Call& call, const Take& take) const {
    const py::gil_scoped_acquire acquire;
    bool is_interrupted = false;
    for (;;) {
      try {
        auto value = take(call(callable_));
        if (is_interrupted) put_off_interrupt();
        return value;
      } catch (const py::error_already_set& e) {
        // Within a step there is no good place to stop.
        if (!e.matches(PyExc_KeyboardInterrupt)) throw CallFailure{std::current_exception()};
        is_interrupted = true;
      } catch (const py::cast_error&) {
        throw CallFailure{std::make_exception_ptr(py::type_error(name_ + " has returned something that is no number"))};
      } catch (const py::builtin_exception&) {
        throw CallFailure{std::current_exception()};
      }
    }
  }
  const std::string& name() const { return name_; }

 private:
  std::string name_;
  py::object callable_;
};

using Doubles = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// Coefficients for n rows, of which one stands for all.
std::vector<double> coefficients(const std::string& name, const py::object& given, std::size_t n) {
  const Doubles found = Doubles::ensure(given);
  if (!found) {
    PyErr_Clear();
    throw py::type_error(name + " has returned something that is no array of numbers");
  }
  const auto size = static_cast<std::size_t>(found.size());
  if (size != n && !(size == 1 && found.ndim() == 0))
    throw py::value_error(name + " has returned " + std::to_string(size) + " numbers for " + std::to_string(n) +
                          " rows");
  std::vector<double> mu(n, *found.data());
  if (size == n) std::copy(found.data(), found.data() + n, mu.begin());
  for (const double value : mu)
    if (!std::isfinite(value) || value < 0.0)
      throw py::value_error(name + " has returned " + fmt::to_string(value) + ", and numbers >= 0 are wanted");
  return mu;
}

}  // namespace

std::function<double(double)> called(const std::string& name, py::object callable) {
  const auto held = std::make_shared<const Held>("functions." + name, std::move(callable));
  return [held](double t) {
    return held->ask([t](const py::object& f) { return f(t); },
                     [&](const py::object& found) {
                       const auto value = py::cast<double>(found);
                       if (std::isfinite(value)) return value;
                       throw py::value_error(held->name() + " has returned " + fmt::to_string(value) +
                                             " at t = " + fmt::to_string(t));
                     });
  };
}

FrictionLaw called_friction(const std::string& contact, py::object callable) {
  const auto held =
      std::make_shared<const Held>("the friction_law of contact \"" + contact + "\"", std::move(callable));
  return [held](const RubbingRows& rows) {
    const std::size_t n = rows.pressure.size();
    const auto count = static_cast<py::ssize_t>(n);
    return held->ask(
        [&](const py::object& f) {
          return f(py::array_t<double>(count, rows.pressure.data()), py::array_t<double>(count, rows.slip_rate.data()),
                   py::array_t<double>({count, py::ssize_t{3}}, rows.position.data()->data()), rows.time);
        },
        [&](const py::object& found) { return coefficients(held->name(), found, n); });
  };
}

bool take_interrupt() {
  return is_put_off.exchange(false);
}

}  // namespace carom::python

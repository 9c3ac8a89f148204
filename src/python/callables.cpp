#include "python/callables.hpp"

#include <atomic>
#include <cmath>
#include <memory>

#include "math/called_function.hpp"

namespace carom::python {

namespace {

std::atomic<bool> is_put_off{false};

void put_off_interrupt() {
  is_put_off.store(true);
  PyErr_SetInterrupt();
}

/// A reference that may be dropped by any thread.
class Held {
 public:
  Held(std::string name, py::object callable) : name_(std::move(name)), callable_(std::move(callable)) {}
  ~Held() {
    const py::gil_scoped_acquire acquire;
    callable_ = py::object();
  }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  double operator()(double t) const {
    const py::gil_scoped_acquire acquire;
    bool is_interrupted = false;
    for (;;) {
      try {
        const double value = py::cast<double>(callable_(t));
        if (is_interrupted) put_off_interrupt();
        if (std::isfinite(value)) return value;
        throw py::value_error("functions." + name_ + " has returned " + std::to_string(value) +
                              " at t = " + std::to_string(t));
      } catch (const py::error_already_set& e) {
        // Within a step there is no good place to stop.
        if (!e.matches(PyExc_KeyboardInterrupt)) throw CallFailure{std::current_exception()};
        is_interrupted = true;
      } catch (const py::cast_error&) {
        throw CallFailure{std::make_exception_ptr(
            py::type_error("functions." + name_ + " has returned something that is no number"))};
      } catch (const py::builtin_exception&) {
        throw CallFailure{std::current_exception()};
      }
    }
  }

 private:
  std::string name_;
  py::object callable_;
};

}  // namespace

std::function<double(double)> called(const std::string& name, py::object callable) {
  const auto held = std::make_shared<const Held>(name, std::move(callable));
  return [held](double t) { return (*held)(t); };
}

bool take_interrupt() {
  return is_put_off.exchange(false);
}

}  // namespace carom::python

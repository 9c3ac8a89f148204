// The extension module carom._carom. What users see stands in the package around it (carom/*.py).
#include "base/version.hpp"
#include "linalg/process_environment.hpp"
#include "python/bindings.hpp"

PYBIND11_MODULE(_carom, module) {
  module.doc() = "The solver behind the package carom; use that.";
  carom::python::bind_errors(module);
  carom::python::bind_cases(module);
  carom::python::bind_meshes(module);
  carom::python::bind_runs(module);
  carom::python::bind_frames(module);
  carom::python::bind_commands(module);
  carom::python::bind_pages(module);
  module.def(
      "version", [] { return carom::version(); }, "Version of Carom.");
  module.def(
      "blas_kernels",
      [] {
        const carom::BlasKernels kernels = carom::blas_kernels();
        return pybind11::make_tuple(kernels.loaded, kernels.better);
      },
      "Kernels that OpenBLAS has loaded, and the value of OPENBLAS_CORETYPE for better ones ('' where there are "
      "none).");
}

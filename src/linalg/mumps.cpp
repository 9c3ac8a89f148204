#include "linalg/mumps.hpp"

#include <fmt/format.h>

#include <utility>

#include "linalg/lapack.hpp"
#include "parallel/ranks.hpp"

namespace carom {

namespace {

constexpr std::size_t error_code = 1, error_detail = 2, ordering = 7, workspace_excess = 14;
constexpr MUMPS_INT given_order = 1;
constexpr MUMPS_INT most_workspace_excess = 1000;  // per cent

double number(MUMPS_INT n) {
  return n >= 0 ? n : -1e6 * n;
}

bool lacks_workspace(MUMPS_INT code) {
  return code == -8 || code == -9 || code == -14 || code == -15 || code == -17 || code == -20;
}

}  // namespace

Mumps::Mumps(Symmetry symmetry) {
  mumps_.par = 1;
  mumps_.sym = static_cast<MUMPS_INT>(symmetry);
  mumps_.comm_fortran = own_communicator();
  call(Job::initialise);
  for (std::size_t stream = 1; stream <= 3; ++stream) control(stream) = -1;  // no output, errors included
  control(4) = 0;
  control(ordering) = given_order;
}

Mumps::~Mumps() {
  call(Job::terminate);
}

MUMPS_INT Mumps::call(Job job) {
  mumps_.job = static_cast<MUMPS_INT>(job);
  dmumps_c(&mumps_);
  return info(error_code);
}

double Mumps::count(std::size_t i) const {
  return number(info(i));
}

MUMPS_INT Mumps::analyse(Index size, std::vector<MUMPS_INT> row, std::vector<MUMPS_INT> column,
                         const std::vector<Index>& order) {
  size_ = size;
  row_ = std::move(row);
  column_ = std::move(column);
  place_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place_[static_cast<std::size_t>(order[k])] = static_cast<int>(k) + 1;
  mumps_.n = size;
  mumps_.nnz = static_cast<MUMPS_INT8>(row_.size());
  mumps_.irn = row_.data();
  mumps_.jcn = column_.data();
  mumps_.perm_in = place_.data();
  const MUMPS_INT code = call(Job::analyse);
  if (code < 0) size_ = 0;  // no pattern has been analysed
  return code < 0 ? code : 0;
}

MUMPS_INT Mumps::factorise(std::vector<double> value) {
  openblas_set_num_threads(1);
  value_ = std::move(value);
  mumps_.a = value_.data();
  MUMPS_INT code = call(Job::factorise);
  while (lacks_workspace(code) && control(workspace_excess) < most_workspace_excess) {
    control(workspace_excess) *= 2;
    code = call(Job::factorise);
  }
  return code < 0 ? code : 0;
}

MUMPS_INT Mumps::solve(double* b, int columns) {
  mumps_.rhs = b;
  mumps_.nrhs = columns;
  mumps_.lrhs = size_;
  const MUMPS_INT code = call(Job::solve);
  return code < 0 ? code : 0;
}

std::string Mumps::reason(MUMPS_INT code) const {
  switch (code) {
    case -5:
    case -7:
    case -13:
    case -19:
    case -22:
      return fmt::format("out of memory ({:.3g} numbers more were asked for); use fewer cells or solver \"cg\"",
                         number(info(error_detail)));
    default:
      if (lacks_workspace(code)) return "out of memory: the pivots need far more workspace than foreseen";
      return fmt::format("MUMPS error {}, detail {}", code, info(error_detail));
  }
}

}  // namespace carom

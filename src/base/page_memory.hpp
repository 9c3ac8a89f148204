// Memory of large vectors that the system gives page by page, when it is written to.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace carom {

/// Makes the values 0. Pages that lie within them whole go back to the system: they take no memory until they are
/// written to again, and are read as zeros all the same.
void release_pages(std::span<double> values);

/// n zeros that take no memory until they are written to.
std::vector<double> unwritten_zeros(std::size_t n);

}  // namespace carom

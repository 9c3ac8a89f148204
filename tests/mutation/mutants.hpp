// Read before every file of a tree that tools/mutate.py has written mutants into: which of them is switched on, and
// which have been reached.
#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>

namespace mutants {

/// More than are ever written in, and whole pages of memory.
inline constexpr int capacity = 4096;

/// The number in the environment variable MUTANT; 0 is none.
inline int active = 0;
/// Whether each mutant has been reached; one memory for a process and those that it starts, where MUTANTS_REACHED names
/// a file.
alignas(4096) inline unsigned char reached[capacity] = {};

inline bool load() {
  if (const char* number = std::getenv("MUTANT")) active = std::atoi(number);
  if (const char* path = std::getenv("MUTANTS_REACHED")) {
    const int file = open(path, O_RDWR);
    if (file < 0 || mmap(reached, capacity, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_FIXED, file, 0) == MAP_FAILED)
      std::abort();
    close(file);
  }
  return true;
}
inline const bool loaded = load();

/// Whether this mutant is switched on. Notes that it was asked for. What the compiler evaluates stays as it was.
constexpr bool on(int number) {
  if (__builtin_is_constant_evaluated()) return false;
  reached[number] = 1;
  return active == number;
}

}  // namespace mutants

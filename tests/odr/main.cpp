// SPDX-License-Identifier: BSD-3-Clause
// Two halves of one program, compiled with and without contracts, call the same inline functions and templates. Were
// the two modes not in different inline namespaces, the linker would keep one definition of each for both halves.

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

bool unchecked_half_counts();
bool unchecked_half_is_unchecked();
bool checked_half_counts();
void checked_half_violates();

int main(int argc, char** argv) {
  if (argc > 1 && std::strcmp(argv[1], "violate") == 0) {
    std::signal(SIGABRT, [](int) { std::_Exit(3); });
    checked_half_violates();
    std::puts("the violation was not noticed");
    return 0;
  }
  const bool fine = unchecked_half_counts() && checked_half_counts() && unchecked_half_is_unchecked();
  return fine ? 0 : 1;
}

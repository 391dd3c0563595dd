// SPDX-License-Identifier: BSD-3-Clause
// A scalar of the laws tells its value without derivatives: value_of.
// expect: value_of\(a\). (is|would be) invalid
#include "tetrapore/core/real.hpp"

struct mine {
  double value;

  explicit mine(double v) : value(v) {}
  friend mine operator+(mine a, mine b) { return mine(a.value + b.value); }
  friend mine operator-(mine a, mine b) { return mine(a.value - b.value); }
  friend mine operator*(mine a, mine b) { return mine(a.value * b.value); }
  friend mine operator/(mine a, mine b) { return mine(a.value / b.value); }
  friend mine operator-(mine a) { return mine(-a.value); }
  friend bool operator<(mine a, mine b) { return a.value < b.value; }
  friend double plain(mine a) { return a.value; }
};
template <>
struct tetrapore::underlying<mine> {
  using type = double;
};
static_assert(tetrapore::real<mine>);

// SPDX-License-Identifier: BSD-3-Clause
// A parameter without a sane default must be given.
// expect: use of deleted function .*required|call to deleted constructor of 'tetrapore::required
#include "tetrapore/core/required.hpp"

struct parameters {
  tetrapore::required<double> surface_tension;
  double contact_angle = 0;
};
parameters p{.contact_angle = 0.3};

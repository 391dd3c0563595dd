// SPDX-License-Identifier: BSD-3-Clause
// A parameter without a sane default must be given.
#include "tetrapore/core/required.hpp"

struct parameters {
  tetrapore::required<double> surface_tension;
  double contact_angle = 0;
};
parameters p{.surface_tension = 0.072, .contact_angle = 0.3};

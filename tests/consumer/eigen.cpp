// SPDX-License-Identifier: BSD-3-Clause
#include <tetrapore/geometry/primitives.hpp>
#include <tetrapore/solver/eigen.hpp>

#include <Eigen/Core>

#include <utility>

bool takes_eigen_positions();

/// A simulator whose positions are Eigen's: tetrapore reads them as they are.
bool takes_eigen_positions() {
  const std::pair<Eigen::Vector3d, double> grain{{1.0, 2.0, 3.0}, 0.5};
  return tetrapore::as_sphere(grain).centre.z == 3.0;
}

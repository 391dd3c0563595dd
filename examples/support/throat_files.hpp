// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/byte_files.hpp"
#include "tetrapore/io/pvd.hpp"
#include "tetrapore/io/vti.hpp"
#include "tetrapore/lbm/entry_experiment.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

/// \file
/// What throat_experiment writes: pictures of the fluids in time.

namespace support {

/// Density of the gas less that of the liquid, one VTI file after another.
class throat_series {
 public:
  /// \param steps  pictures of up to as many stay in the series: those of a run that this one takes up
  throat_series(std::filesystem::path folder, const std::string& name, std::uint64_t steps)
      : folder_(std::move(folder)), name_(name + "_"), list_(folder_ / (name + ".pvd")) {
    std::vector<std::filesystem::path> earlier;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      const std::filesystem::path& file = entry.path();
      if (file.extension() == ".vti" && file.stem().string().starts_with(name_) && steps_of(file) <= steps) {
        earlier.push_back(file);
      }
    }
    std::sort(earlier.begin(), earlier.end());
    for (const auto& file : earlier) {
      list_.add(static_cast<double>(steps_of(file)), file);
    }
  }

  /// \param steps  since the first
  template <class Experiment>
  void add(const Experiment& e, std::uint64_t steps) {
    const auto& map = e.fluids().sites();
    const auto& size = e.throat().box().size;
    const auto count = [&](std::size_t axis) { return static_cast<std::size_t>(size[axis]); };
    std::vector<float> difference(count(0) * count(1) * count(2), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t n = 0; n < map.size(); ++n) {
      const auto& p = map.place(n);
      const auto rho = e.fluids().densities_at(n);
      const auto at = (static_cast<std::size_t>(p[2]) * count(1) + static_cast<std::size_t>(p[1])) * count(0) +
                      static_cast<std::size_t>(p[0]);
      difference[at] = static_cast<float>(rho[0] - rho[1]);
    }
    char number[20];
    std::snprintf(number, sizeof number, "%09llu.vti", static_cast<unsigned long long>(steps));
    const std::string name = name_ + number;
    const double h = 1 / e.set_up().nodes_per_length;
    tetrapore::io::write_image(folder_ / name, {size, {0.5 * h, 0.5 * h, -e.throat().middle() * h}, h},
                               {{"density_difference", difference}});
    list_.add(static_cast<double>(steps), folder_ / name);
    list_.write();
  }

 private:
  [[nodiscard]] static std::uint64_t steps_of(const std::filesystem::path& file) {
    const std::string name = file.stem().string();
    return std::strtoull(name.c_str() + std::min(name.size(), name.find('_') + 1), nullptr, 10);
  }

  std::filesystem::path folder_;
  std::string name_;
  tetrapore::io::pvd_series list_;
};

}  // namespace support

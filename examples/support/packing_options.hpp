// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "support/grains.hpp"
#include "support/number_options.hpp"
#include "support/options.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <filesystem>
#include <string>

/// \file
/// What every program is asked that reads a packing and writes a folder.

namespace support {

struct packing_job : grain_source {
  std::filesystem::path out;
};

[[nodiscard]] inline bool positive(double x) { return x > 0; }

/// The options PACKING, --periodic, --scale and --out of a command line. A program adds its own to the same `app`.
/// Values are taken as text and read by support/options.hpp, so that all refusals have one form.
class packing_options {
 public:
  /// \param shipped  the packing that is read where none is named
  packing_options(CLI::App& app, const std::filesystem::path& shipped)
      : app_(app), packing_(shipped.string()), out_(app.get_name() + "_out") {
    app.add_option("PACKING", packing_,
                   "file of spheres: text, CSV, LAMMPS/LIGGGHTS dump, .xyzd, pack.out, Yade export")
        ->capture_default_str();
    app.add_option("--periodic", periodic_, "axes along which the box repeats, such as xz (default: as the file says)");
    app.add_option("--scale", scale_, "metres per unit of length of the file")->capture_default_str();
    app.add_option("--out", out_, "folder for the files")->capture_default_str();
  }
  packing_options(const packing_options&) = delete;  // the command line keeps references to its values
  packing_options& operator=(const packing_options&) = delete;

  /// Reads the command line, and of the job what all have in common; false when only help was asked for, which is then
  /// printed.
  /// \throw tetrapore::parameter_error  names the option, what it was given and what it takes
  [[nodiscard]] bool read(int argc, char** argv, packing_job& job) const {
    if (!parsed(app_, argc, argv)) {
      return false;
    }
    job.path = packing_;
    if (app_.count("--periodic") > 0) {
      job.periodic = axes_of("--periodic", periodic_);
    }
    job.scale = number_of("--scale", scale_, positive, "a number above 0 [metres per unit of the file]");
    job.out = folder_of("--out", out_);
    return true;
  }

 private:
  CLI::App& app_;
  std::string packing_;
  std::string periodic_;
  std::string scale_ = "1";
  std::string out_;
};

}  // namespace support

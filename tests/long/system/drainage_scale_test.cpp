// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: from spheres to the drained state with exact trapping, 10,000 to 1,000,000 grains. One file of results per
// size, docs/campaigns/drainage_<grains>.json; a size that has its file is not run again.
#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "tetrapore/law/entry.hpp"
#include "tetrapore/network.hpp"
#include "tetrapore/two_phase.hpp"

#include <doctest/doctest.h>

#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>

using namespace tetrapore;

namespace {

struct stopwatch {
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start, now)).count();
  }
};

template <gap_model Model>
struct invasion_figures {
  double laws;
  double invasion;
  double balance;
  double half;
  double residual;

  explicit invasion_figures(const network& net) {
    stopwatch watch;
    facet_rule<mayer_stowe_princen, Model> rule(net, {.surface_tension = 1.0});
    laws = watch.lap();
    drainage d(net, rule);
    d.run();
    invasion = watch.lap();
    double stayed = 0;
    for (std::size_t i = 0; i < net.pore_count(); ++i) {
      stayed += d.state().is_reservoir(pore_id(i)) ? 0.0 : d.state().liquid()[pore_id(i)];
    }
    balance = std::abs(d.drained_liquid() + stayed - d.initial_liquid()) / d.initial_liquid();
    const retention_curve curve(d);
    half = curve.pressure_at(0.5).value_or(std::nan(""));
    residual = curve.end_saturation();
  }
};

}  // namespace

TEST_CASE("primary drainage with trapping scales to a million grains") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  for (const std::size_t n : {10000U, 40000U, 100000U, 1000000U}) {
    const auto path = folder / ("drainage_" + std::to_string(n) + ".json");
    if (std::filesystem::exists(path)) {
      MESSAGE("there already: " << path.filename().string());
      continue;
    }
    const packing p = dense_packing(n);
    // what the bare triangulation of the same spheres takes: the limit in the same run [s]
    const double limit = triangulate_bare(p.grains).seconds;
    stopwatch watch;
    const auto t = compiled_triangulation{}(p.grains, domain_of(p));
    const double tessellation = watch.lap();
    const invasion_figures<gap_model::lost_arc> fixed(t.net);
    const double box = compensated_sum(t.net.arrays().volumes);
    const double defect = std::abs(compensated_sum(t.net.arrays().void_volumes) + solid_volume(t.net) - box) / box;
    CHECK(defect < 1e-12);
    // a running sum of as many volumes as there are pores
    CHECK(fixed.balance < epsilon<double> * static_cast<double>(t.net.pore_count()));
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    std::string merged;
    if (n <= 100000) {
      const invasion_figures<gap_model::merged> m(t.net);
      CHECK(m.balance < epsilon<double> * static_cast<double>(t.net.pore_count()));
      merged = ",\n  \"merged\": {\"seconds_laws\": " + std::to_string(m.laws) +
               ", \"seconds_invasion\": " + std::to_string(m.invasion) + ", \"factor\": " +
               std::to_string((tessellation + m.laws + m.invasion) / (tessellation + fixed.laws + fixed.invasion)) +
               ", \"pc_s50\": " + std::to_string(m.half) + ", \"residual\": " + std::to_string(m.residual) + "}";
    }
    const double all = tessellation + fixed.laws + fixed.invasion;
    const auto part = path.string() + ".part";
    std::ofstream(part) << "{\n  \"command\": \"tests/run.sh --long long_system\",\n  \"grains\": " << n
                        << ",\n  \"pores\": " << t.net.pore_count() << ",\n  \"throats\": " << t.net.throat_count()
                        << ",\n  \"seconds_bare_triangulation\": " << limit
                        << ",\n  \"seconds_tessellation\": " << tessellation << ",\n  \"seconds_laws\": " << fixed.laws
                        << ",\n  \"seconds_invasion\": " << fixed.invasion << ",\n  \"seconds_all\": " << all
                        << ",\n  \"all_over_bare_triangulation\": " << all / limit
                        << ",\n  \"volume_defect\": " << defect << ",\n  \"volume_balance\": " << fixed.balance
                        << ",\n  \"pc_s50\": " << fixed.half << ",\n  \"residual\": " << fixed.residual
                        << ",\n  \"peak_rss_mb\": " << usage.ru_maxrss / 1024 << merged << "\n}\n";
    std::filesystem::rename(part, path);
    MESSAGE(n << " grains: " << all << " s, " << all / limit << " times the bare triangulation");
  }
}

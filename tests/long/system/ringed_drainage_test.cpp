// SPDX-License-Identifier: BSD-3-Clause
//
// Campaign: what it does to a retention curve that the ring in each gap must exist as a bridge at that suction, on a
// packing of 10,000 beads beside the project (docs/campaigns/ringed_drainage.json).
#include "support/compiled_triangulation.hpp"
#include "support/ringed_curves.hpp"
#include "support/shared_data.hpp"

#include "tetrapore/io/read_packing.hpp"

#include <filesystem>
#include <fstream>
#include <string>

using namespace ringed_curves;

TEST_CASE("rings that have to exist, and the retention curve of 10,000 beads") {
  const std::filesystem::path folder = TETRAPORE_CAMPAIGN_DIR;
  std::filesystem::create_directories(folder);
  const auto path = folder / "ringed_drainage.json";
  if (std::filesystem::exists(path)) {
    MESSAGE("there already: " << path.filename().string());
    return;
  }
  const auto beads = shared_file("data/packings/open_10000.txt");
  if (!beads) {
    return;
  }
  const packing p = io::read_packing(*beads).packing;
  const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
  double radius = 0;
  for (const auto& g : p.grains) {
    radius += g.radius / static_cast<double>(p.grains.size());
  }
  const mayer_stowe_princen arcs{.surface_tension = 1.0};
  const with_rings rings = law_of_water();
  const figures lost = drained<gap_model::lost_arc>(net, arcs);
  const figures merged = drained<gap_model::merged>(net, arcs);
  const figures lost_rings = drained<gap_model::lost_arc>(net, rings);
  const figures merged_rings = drained<gap_model::merged>(net, rings);
  CHECK(lost_rings.limited > lost.limited);
  CHECK(lost_rings.half < lost.half);
  CHECK(merged_rings.half < merged.half);
  const auto row = [&](const char* name, const figures& f) { return json_row(name, f, radius); };
  const auto part = path.string() + ".part";
  std::ofstream(part) << "{\n  \"command\": \"tests/run.sh --long long_system\",\n  \"packing\": \"open_10000\",\n"
                      << "  \"throats\": " << net.throat_count() << ",\n"
                      << row("lost_arc", lost) << ",\n"
                      << row("merged", merged) << ",\n"
                      << row("lost_arc_with_rings", lost_rings) << ",\n"
                      << row("merged_with_rings", merged_rings) << "\n}\n";
  std::filesystem::rename(part, path);
}

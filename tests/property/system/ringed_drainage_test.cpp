// SPDX-License-Identifier: BSD-3-Clause
#include "support/compiled_triangulation.hpp"
#include "support/dense_packing.hpp"
#include "support/ringed_curves.hpp"

#include <doctest/doctest.h>

using namespace ringed_curves;

TEST_CASE("rings that have to exist let gas in sooner: thresholds of facets never rise, and the curve falls") {
  const packing p = dense_packing(1000);
  const network net = compiled_triangulation{}(p.grains, domain_of(p)).net;
  const mayer_stowe_princen arcs{.surface_tension = 1.0};
  const facet_rule<mayer_stowe_princen, gap_model::lost_arc> plain(net, arcs);
  const facet_rule<with_rings, gap_model::lost_arc> ringed_facets(net, law_of_water());
  std::size_t lower = 0;
  std::size_t higher = 0;
  std::size_t same = 0;
  for (std::size_t i = 0; i < net.throat_count(); ++i) {
    const double before = plain.alone(throat_id(i)).value;
    const double after = ringed_facets.alone(throat_id(i)).value;
    lower += after < before ? 1U : 0U;
    higher += after > before * (1 + 1e-12) ? 1U : 0U;
    same += after == before ? 1U : 0U;
  }
  CHECK(higher == 0);
  CHECK(lower > net.throat_count() / 2);
  CHECK(same > 100);
  const figures without = drained<gap_model::lost_arc>(net, arcs);
  const figures with = drained<gap_model::lost_arc>(net, law_of_water());
  CHECK(with.limited > without.limited);
  CHECK(with.half < without.half);
  MESSAGE(net.throat_count() << " throats; gap-limited " << without.limited << ", with rings " << with.limited
                             << "; p_c at S = 0.5 " << without.half << ", with rings " << with.half);
}

TEST_CASE("a curve that never passes S = 0.5 at a suction above 0 has no p_c there, and the campaign says null") {
  CHECK(json_row("a", {7, 2.0, 0.25}, 0.5) ==
        "  \"a\": {\"gap_limited\": 7, \"pc_s50\": 1.000000, \"residual\": 0.250000}");
  for (const double none : {0.0, std::nan("")}) {
    CHECK(json_row("b", {7, none, 0.25}, 0.5) ==
          "  \"b\": {\"gap_limited\": 7, \"pc_s50\": null, \"residual\": 0.250000}");
  }
}

// SPDX-License-Identifier: BSD-3-Clause
//
// Geometry of a pore, one row per kernel: time per call; `error`, the worst difference from the same formula in long
// double, in units of the natural scale of each row (cell size cubed, length, steradian); `failed`, the answers that
// were refused. The inputs are distinct, in random order and larger than the L2 cache.

#include "tetrapore/geometry.hpp"
#include "tetrapore/simplex.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

namespace {

using namespace tetrapore;

constexpr std::size_t input_count = std::size_t{1} << 14;

struct input {
  pore_body<double> body;
  sphere<double> intruder;
};

sphere<long double> widen(const sphere<double>& s) { return {{s.centre.x, s.centre.y, s.centre.z}, s.radius}; }

pore_body<long double> widen(const pore_body<double>& b) {
  pore_body<long double> wide{};
  wide.grain_count = b.grain_count;
  for (std::size_t k = 0; k < b.grain_count; ++k) {
    wide.grains[k] = widen(b.grains[k]);
  }
  for (std::size_t k = 0; k < b.wall_count(); ++k) {
    const auto& w = b.walls[k];
    wide.walls[k] = {{w.point.x, w.point.y, w.point.z}, {w.normal.x, w.normal.y, w.normal.z}};
  }
  return wide;
}

// Four grains of radii 0.5 to 1 with gaps up to a fifth of their distance, anywhere in a box of side 100. A flatness
// above 0 squeezes the fourth towards the plane of the others, until grains overlap and reach through.
std::vector<input> pores(double flatness) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::normal_distribution<double> normal;
  std::vector<input> all;
  while (all.size() < input_count) {
    double r[4];
    for (double& x : r) {
      x = 0.5 + 0.5 * uniform(random);
    }
    const auto edge = [&](int i, int j) { return (r[i] + r[j]) * (1 + 0.2 * uniform(random)); };
    const double a = edge(0, 1), b = edge(0, 2), c = edge(1, 2), d = edge(0, 3), e = edge(1, 3), f = edge(2, 3);
    const double x2 = (a * a + b * b - c * c) / (2 * a), y2 = std::sqrt(b * b - x2 * x2);
    const double x3 = (a * a + d * d - e * e) / (2 * a);
    const double y3 = (b * b + d * d - f * f - 2 * x2 * x3) / (2 * y2);
    const double z3 = std::sqrt(d * d - x3 * x3 - y3 * y3) * (1 - flatness);
    vec3<double> u{normal(random), normal(random), normal(random)};
    u = u / norm(u);
    vec3<double> v{normal(random), normal(random), normal(random)};
    v = cross(u, v);
    v = v / norm(v);
    const vec3<double> w = cross(u, v);
    const vec3<double> at = vec3<double>{uniform(random), uniform(random), uniform(random)} * 100.0;
    input one{};
    one.body.grain_count = 4;
    one.body.grains = {sphere<double>{at, r[0]}, sphere<double>{at + u * a, r[1]},
                       sphere<double>{at + u * x2 + v * y2, r[2]}, sphere<double>{at + u * x3 + v * y3 + w * z3, r[3]}};
    // a grain behind the first facet that reaches into the cell
    const auto& g = one.body.grains;
    const auto area = triangle_area(g[1].centre, g[2].centre, g[3].centre);
    const auto middle = (g[1].centre + g[2].centre + g[3].centre) / 3.0;
    one.intruder = {middle + area / norm(area) * 0.4, 0.5};
    all.push_back(one);
  }
  std::shuffle(all.begin(), all.end(), random);
  return all;
}

// Runs `kernel(input, T{}) -> pair(value, answered)` over the inputs and compares it with itself in long double.
template <class Kernel>
void measure(benchmark::State& state, const std::vector<input>& all, const Kernel& kernel) {
  double worst = 0;
  double failed = 0;
  for (const auto& one : all) {
    const auto [value, answered] = kernel(one.body, one.intruder);
    const auto [exact, exact_answered] = kernel(widen(one.body), widen(one.intruder));
    failed += answered && exact_answered ? 0 : 1;
    if (answered && exact_answered) {
      worst = std::max(worst, std::fabs(static_cast<double>(static_cast<long double>(value) - exact)));
    }
  }
  std::size_t k = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(kernel(all[k].body, all[k].intruder));
    k = k + 1 == all.size() ? 0 : k + 1;
  }
  state.counters["error"] = worst;
  state.counters["failed"] = failed;
}

template <class T>
struct answer {
  T value;
  bool answered;
};

template <class T>
answer<T> of(const outcome<T, geometry_status>& o) {
  return {o.value, o.ok()};
}

void solid_angle_of_a_triangle(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>&) {
    const auto& o = b.grains[0].centre;
    return answer<T>{solid_angle(b.grains[1].centre - o, b.grains[2].centre - o, b.grains[3].centre - o), true};
  });
}
BENCHMARK(solid_angle_of_a_triangle);

void power_centre_of_a_tetrahedron(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>&) {
    const auto p = power_centre(b);
    return answer<T>{p.value.x, p.ok()};
  });
}
BENCHMARK(power_centre_of_a_tetrahedron);

void total_volume_of_a_tetrahedron(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>&) {
    return answer<T>{total_volume(b), true};
  });
}
BENCHMARK(total_volume_of_a_tetrahedron);

void total_and_sector_volume(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>&) {
    return answer<T>{total_volume(b) - sector_volume(b), true};
  });
}
BENCHMARK(total_and_sector_volume);

void void_volume_when_sectors_are_exact(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>&) { return of(void_volume(b)); });
}
BENCHMARK(void_volume_when_sectors_are_exact);

// The same cells with radii reduced until no pair overlaps: some grains still reach through the opposite facet.
void void_volume_of_a_flat_pore(benchmark::State& state) {
  auto all = pores(0.6);
  for (auto& one : all) {
    auto& g = one.body.grains;
    double room = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        room = std::min(room, norm(g[i].centre - g[j].centre) / (g[i].radius + g[j].radius));
      }
    }
    for (auto& grain : g) {
      grain.radius *= room;
    }
  }
  measure(state, all, []<class T>(const pore_body<T>& b, const sphere<T>&) { return of(void_volume(b)); });
}
BENCHMARK(void_volume_of_a_flat_pore);

void void_volume_of_overlapping_grains(benchmark::State& state) {
  measure(state, pores(0.6), []<class T>(const pore_body<T>& b, const sphere<T>&) { return of(void_volume(b)); });
}
BENCHMARK(void_volume_of_overlapping_grains);

void void_volume_with_an_overlapping_intruder(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>& s) {
    return of(void_volume(b, std::span<const sphere<T>>(&s, 1)));
  });
}
BENCHMARK(void_volume_with_an_overlapping_intruder);

void void_volume_shared_by_two_cells(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>& s) {
    pore_body<T> moved = b;
    moved.grains[0] = {s.centre, b.grains[0].radius};
    std::swap(moved.grains[1], moved.grains[2]);
    return of(void_overlap(b, moved, std::span<const sphere<T>>(b.grains)));
  });
}
BENCHMARK(void_volume_shared_by_two_cells);

void ball_in_a_tetrahedron(benchmark::State& state) {
  measure(state, pores(0), []<class T>(const pore_body<T>& b, const sphere<T>& s) {
    polyhedron<T> p;
    for (const auto& g : b.grains) {
      p.add_vertex(g.centre);
    }
    using face_corners = std::array<std::uint8_t, 3>;
    for (const auto& f : {face_corners{1, 2, 3}, face_corners{0, 3, 2}, face_corners{0, 1, 3}, face_corners{0, 2, 1}}) {
      const auto area = triangle_area(b.grains[f[0]].centre, b.grains[f[1]].centre, b.grains[f[2]].centre);
      p.add_face(area / norm(area), f);
    }
    return answer<T>{ball_volume(s, p), true};
  });
}
BENCHMARK(ball_in_a_tetrahedron);

}  // namespace

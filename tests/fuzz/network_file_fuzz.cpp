// SPDX-License-Identifier: BSD-3-Clause
//
// Alters a saved network byte by byte, puts the checksum right, and loads it. The loader may accept it or throw
// setup_error; a network that it accepts must bear being walked: anything else that happens is a fault.
//
//   clang++-16 -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I include -I tests
//       tests/fuzz/network_file_fuzz.cpp -o network_file_fuzz
//   ./network_file_fuzz -max_total_time=60

#include "tetrapore/io/network_file.hpp"
#include "tetrapore/io/vtu.hpp"
#include "tetrapore/network/edges.hpp"

#include "support/small_networks.hpp"

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

namespace {

using namespace tetrapore;

const std::filesystem::path& file() {
  static const std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("tetrapore-fuzz-" + std::to_string(::getpid()) + ".tpn");
  return path;
}

std::string saved(const network& net) {
  io::save_network(file(), net);
  std::ifstream in(file(), std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// The networks to start from.
const std::vector<std::string>& seeds() {
  static const std::vector<std::string> all = [] {
    std::atexit([] { std::filesystem::remove(file()); });
    network_arrays a = one_tetrahedron().arrays();
    a.region.bounds = {{0, 0, 0}, {3, 3, 3}};
    a.region.faces.fill(boundary::periodic);
    a.pore_images.push_back({});
    a.throat_shifts.resize(a.throat_pores.size());
    return std::vector<std::string>{saved(two_grains_in_a_box()), saved(one_prism()), saved(network(std::move(a)))};
  }();
  return all;
}

void walk(const network& net) {
  volatile double sum = 0;
  for (std::size_t t = 0; t < net.throat_count(); ++t) {
    sum = sum + norm(throat_at(net, throat_id(t)).area_vector);
  }
  for (std::size_t p = 0; p < net.pore_count(); ++p) {
    sum = sum + pore_body_at(net, pore_id(p)).grains[0].radius;
    for (const face f : all_faces) {
      sum = sum + (net.touches(pore_id(p), f) ? 1 : 0);
    }
    const edge_cursor start{pore_id(p), 0, 1, 2, 3, {}};
    if (start.exit(net).valid() && !net.vertices(pore_id(p))[1].is_wall()) {
      sum = sum + (next_around(net, start) ? 1 : 0);
    }
  }
  io::write_pores(file().string() + ".vtu", net, {});
  std::filesystem::remove(file().string() + ".vtu");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  if (size < 1) {
    return 0;
  }
  std::string bytes = seeds()[data[0] % seeds().size()];
  for (std::size_t i = 1; i + 3 <= size; i += 3) {  // where (2 bytes), what (1 byte)
    const std::size_t at = (std::size_t{data[i]} << 8U | data[i + 1]) % bytes.size();
    bytes[at] = static_cast<char>(data[i + 2]);
  }
  constexpr std::size_t sum_at = offsetof(io::detail::network_header, sum);
  if (data[0] < 250) {  // a few runs keep the wrong checksum
    io::detail::checksum sum;
    sum.add(bytes.data(), sum_at);
    std::size_t at = sizeof(io::detail::network_header);
    const auto part = [&](std::size_t count) {
      sum.add(bytes.data() + at, count);
      at += count;
    };
    io::detail::network_header header;
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.grains < 1000 && header.pores < 1000 && header.throats < 1000 && header.periodic < 2 &&
        io::detail::payload_size(header) + sizeof header == bytes.size()) {
      part(sizeof(io::detail::stored_domain));
      network_arrays none;
      io::detail::visit_network_arrays(none, header, [&](const auto& array, std::uint64_t rows) {
        part(static_cast<std::size_t>(rows) * sizeof(typename std::remove_cvref_t<decltype(array)>::value_type));
      });
      const std::uint64_t value = sum.value();
      std::memcpy(bytes.data() + sum_at, &value, sizeof value);
    }
  }
  {
    std::ofstream out(file(), std::ios::binary);
    out << bytes;
  }
  try {
    walk(io::load_network(file()));
  } catch (const setup_error&) {
  }
  return 0;
}

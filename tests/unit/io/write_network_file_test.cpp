// SPDX-License-Identifier: BSD-3-Clause
#include "tetrapore/io/network_file.hpp"

#include "support/small_networks.hpp"
#include "support/temporary_folder.hpp"

#include <random>

using namespace tetrapore;

namespace {

bool same(const network& x, const network& y) {
  const network_arrays& a = x.arrays();
  const network_arrays& b = y.arrays();
  return x.epoch() == y.epoch() && a.grains == b.grains && a.pore_vertices == b.pore_vertices &&
         a.pore_images == b.pore_images && a.pore_throats == b.pore_throats && a.power_centres == b.power_centres &&
         a.volumes == b.volumes && a.void_volumes == b.void_volumes && a.throat_pores == b.throat_pores &&
         a.throat_slots == b.throat_slots && a.throat_shifts == b.throat_shifts && a.region.faces == b.region.faces &&
         a.region.bounds.lo == b.region.bounds.lo && a.region.bounds.hi == b.region.bounds.hi;
}

network periodic_tetrahedron() {
  network net = one_tetrahedron();
  network_arrays a = net.arrays();
  a.region.bounds = {{0, 0, 0}, {3, 3, 3}};
  a.region.faces.fill(boundary::periodic);
  a.pore_images.push_back({image{0, 0, 0}, image{1, 0, 0}, image{0, 1, 0}, image{0, 0, 1}});
  a.throat_shifts.assign(a.throat_pores.size(), image{1, -1, 0});
  return network(std::move(a), 3);
}

std::string message_of(const std::filesystem::path& path) {
  try {
    (void)io::load_network(path);
  } catch (const input_error& e) {
    return std::string(e.what()).substr(path.string().size());
  }
  return "";
}

}  // namespace

TEST_CASE("a network comes back from its file to the last bit") {
  const temporary_folder folder("net");
  for (const network& net : {two_grains_in_a_box(), one_prism(), one_tetrahedron(), periodic_tetrahedron()}) {
    io::save_network(folder / "a.tpn", net);
    CHECK(same(io::load_network(folder / "a.tpn"), net));
  }
  CHECK(folder.files() == 1);
}

TEST_CASE("any byte that changes is noticed") {
  const temporary_folder folder("flip");
  io::save_network(folder / "a.tpn", two_grains_in_a_box());
  const std::string good = contents_of(folder / "a.tpn");
  std::size_t accepted = 0;
  for (std::size_t k = 0; k < good.size(); ++k) {
    std::string bad = good;
    bad[k] = static_cast<char>(bad[k] ^ (1 << (k % 8)));
    set_contents(folder / "b.tpn", bad);
    try {
      (void)io::load_network(folder / "b.tpn");
      ++accepted;
    } catch (const input_error&) {
    }
  }
  CHECK(accepted == 0);
}

TEST_CASE("a file cut anywhere is refused, and the message names the byte where it ends") {
  const temporary_folder folder("cut");
  io::save_network(folder / "a.tpn", two_grains_in_a_box());
  const std::string good = contents_of(folder / "a.tpn");
  for (std::size_t k = 0; k < good.size(); k += k < 100 ? 1 : 37) {
    set_contents(folder / "b.tpn", good.substr(0, k));
    const std::string message = message_of(folder / "b.tpn");
    CHECK_MESSAGE(message.find(": byte " + std::to_string(k) + ": found the end of the file") == 0, message);
  }
  set_contents(folder / "b.tpn", good + "x");
  CHECK(message_of(folder / "b.tpn").find(": byte " + std::to_string(good.size()) + ": found more bytes") == 0);
}

TEST_CASE("a foreign file, another version and another byte order are told apart") {
  const temporary_folder folder("foreign");
  io::save_network(folder / "a.tpn", one_prism());
  const std::string good = contents_of(folder / "a.tpn");
  const auto with = [&](std::size_t at, const std::string& bytes) {
    std::string bad = good;
    bad.replace(at, bytes.size(), bytes);
    set_contents(folder / "b.tpn", bad);
    return message_of(folder / "b.tpn");
  };
  CHECK(with(0, "solid no").find(": byte 0:") == 0);
  CHECK(with(8, "\x0a\x0b\x0c\x0d").find(": byte 8: found the byte order") == 0);
  CHECK(with(12, "\x02").find(": byte 12: found version 2, expected version 1") == 0);
  CHECK(with(24, std::string(8, '\x7f')).find(": byte 24:") ==
        0);  // more pores than there can be, nothing is allocated
  CHECK(with(16, std::string("\x00\x00\x00\x10", 4)).find(": byte 56:") == 0);
  CHECK(message_of(folder / "absent.tpn") == ": found No such file or directory, expected a file that can be read");
}

TEST_CASE("arrays that do not form a network are refused although the file is whole") {
  const temporary_folder folder("invalid");
  network_arrays a = one_tetrahedron().arrays();
  a.pore_vertices[0][2] = vertex(grain_id(9));
  io::save_network(folder / "a.tpn", network(a));
  CHECK_THROWS_AS((void)io::load_network(folder / "a.tpn"), network_error);
}

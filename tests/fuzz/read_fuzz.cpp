// SPDX-License-Identifier: BSD-3-Clause
//
// Feeds arbitrary bytes to every reader of packings. A reader may accept them or throw setup_error (input_error,
// packing_error, parameter_error): anything else that happens is a fault.
//
//   clang++-16 -std=c++20 -g -O1 -fsanitize=fuzzer,address,undefined -fno-sanitize-recover=all -I include
//       tests/fuzz/read_fuzz.cpp -o read_fuzz
//   ./read_fuzz -max_total_time=60 CORPUS tests/fuzz/corpus        (new inputs go to CORPUS, the first folder)
//   TETRAPORE_FUZZ_FORMAT=dump ./read_fuzz …                       (one format: text csv yade dump xyzd pack_out sizes)
//
// Without libFuzzer, -DTETRAPORE_FUZZ_STANDALONE gives a program that replays the files and folders named on its
// command line.

#include "tetrapore/io/read_packing.hpp"
#include "tetrapore/io/read_sizes.hpp"
#include "tetrapore/io/write_packing.hpp"
#include "tetrapore/packing/check.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

namespace {

using tetrapore::io::packing_format;
using tetrapore::io::read_options;

[[noreturn]] void fault(const char* what) {
  std::fprintf(stderr, "fault: %s\n", what);
  std::abort();
}

/// What a reader promises of whatever it accepts.
void examine(const tetrapore::io::read_result& r) {
  if (r.packing.grains.empty() || r.report.grains_read < r.packing.grains.size()) {
    fault("a reader returned no grain, or lost count");
  }
  for (const auto& g : r.packing.grains) {
    if (!tetrapore::finite(g.centre) || !(g.radius > 0) || !std::isfinite(g.radius)) {
      fault("a reader returned a grain that is not finite");
    }
  }
  if (r.packing.bounds) {
    const auto& b = *r.packing.bounds;
    for (std::size_t k = 0; k < 3; ++k) {
      if (!(b.lo[k] < b.hi[k])) {
        fault("a reader returned an inverted box");
      }
      for (const auto& g : r.packing.grains) {
        if (r.packing.periodic[k] && !(g.centre[k] >= b.lo[k] && g.centre[k] < b.hi[k])) {
          fault("a reader left a grain outside a periodic box");
        }
      }
    }
  }
  const auto again = tetrapore::io::read_packing_from_memory(tetrapore::io::packing_text(r.packing), "again.txt");
  if (again.packing.grains != r.packing.grains) {
    fault("a packing written and read again has changed");
  }
  tetrapore::check(r.packing);
}

template <class F>
void expect_answer_or_setup_error(F&& f) {
  try {
    f();
  } catch (const tetrapore::setup_error& error) {
    const std::string_view message = error.what();
    if (message.find("found ") == message.npos || message.find("expected ") == message.npos) {
      fault("a message without what was found and expected");
    }
  }
}

bool wanted(const char* format) {
  static const char* only = std::getenv("TETRAPORE_FUZZ_FORMAT");
  return only == nullptr || std::string_view(only) == format;
}

void feed(std::string_view content) {
  struct target {
    const char* name;
    packing_format format;
    read_options options;
  };
  static const std::vector<target> targets{
      {"automatic", packing_format::automatic, {}},
      {"text", packing_format::text, {.scale = 1e-3}},
      {"text", packing_format::text, {.columns = {.x = 1, .y = 2, .z = 3}, .radius = 1.0}},
      {"csv", packing_format::csv, {.columns = {.diameter = "size"}, .longest_line = 64}},
      {"csv", packing_format::csv, {}},
      {"yade", packing_format::yade, {}},
      {"dump", packing_format::dump, {}},
      {"dump", packing_format::dump, {.snapshot = 1}},
      {"xyzd", packing_format::xyzd, {}},
      {"pack_out", packing_format::pack_out, {}},
  };
  for (const auto& t : targets) {
    if (!wanted(t.name)) {
      continue;
    }
    auto options = t.options;
    options.format = t.format;
    expect_answer_or_setup_error(
        [&] { examine(tetrapore::io::read_packing_from_memory(content, "fuzz.txt", options)); });
  }
  if (wanted("xyzd")) {  // the bytes as the binary file, and as the text beside it
    constexpr std::array<char, 32> grain{0, 0, 0, 0, 0, 0, 0x40, 0x40, 0, 0, 0, 0, 0, 0, 0x40, 0x40,
                                         0, 0, 0, 0, 0, 0, 0x40, 0x40, 0, 0, 0, 0, 0, 0, 0x40, 0x40};
    expect_answer_or_setup_error([&] {
      examine(tetrapore::io::read_packing_from_memory(content, "p.xyzd", {}, "N: 4\nDimensions: 10 10 10\n"));
    });
    expect_answer_or_setup_error([&] {
      examine(tetrapore::io::read_packing_from_memory({grain.data(), grain.size()}, "p.xyzd", {}, content));
    });
  }
  if (wanted("sizes")) {
    expect_answer_or_setup_error([&] {
      const auto curve = tetrapore::io::read_sizes_from_memory(content, "sizes.csv");
      for (const double radius : tetrapore::radii_by_mass(50, curve)) {
        if (!(radius > 0) || !std::isfinite(radius)) {
          fault("a grading curve gave a radius that is not above 0");
        }
      }
    });
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  feed({reinterpret_cast<const char*>(data), size});
  return 0;
}

#ifdef TETRAPORE_FUZZ_STANDALONE
#include <filesystem>
#include <fstream>
#include <iterator>

int main(int argc, char** argv) {
  std::size_t replayed = 0;
  const auto replay = [&](const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string content{std::istreambuf_iterator<char>(file), {}};
    feed(content);
    ++replayed;
  };
  for (int k = 1; k < argc; ++k) {
    if (std::filesystem::is_directory(argv[k])) {
      for (const auto& entry : std::filesystem::directory_iterator(argv[k])) {
        replay(entry.path());
      }
    } else {
      replay(argv[k]);
    }
  }
  std::printf("replayed=%zu\n", replayed);
  return replayed > 0 ? 0 : 1;
}
#endif

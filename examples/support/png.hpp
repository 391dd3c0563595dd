// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"

#include <png.h>

#include <cstdint>
#include <vector>

/// \file
/// An image in memory, and its way into a PNG file.

namespace support {

struct rgb {
  std::uint8_t r = 255;
  std::uint8_t g = 255;
  std::uint8_t b = 255;
};

struct picture {
  std::uint32_t width;
  std::uint32_t height;
  std::vector<rgb> pixels;  ///< rows from top to bottom

  picture(std::uint32_t w, std::uint32_t h) : width(w), height(h), pixels(std::size_t{w} * h) {}
  [[nodiscard]] rgb& at(std::size_t x, std::size_t y) { return pixels[y * width + x]; }
};

inline void write_png(const std::filesystem::path& path, const picture& p) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = p.width;
  image.height = p.height;
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::vector<unsigned char> bytes(size);
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, p.pixels.data(), 0, nullptr) == 0) {
    throw tetrapore::io::output_error(path, image.message);
  }
  tetrapore::io::output_file file(path);
  file.write(bytes.data(), size);
  file.commit();
}

}  // namespace support

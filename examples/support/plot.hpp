// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "tetrapore/io/output_file.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

/// \file
/// A line plot as an SVG file, drawn by ourselves: nothing to install, and the picture does not depend on a version.

namespace support {

struct curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;
  std::string colour = "#2b6cb0";
  std::string dashes;  ///< of the line, as SVG has them: "6 4"; empty for a full line
  bool steps = false;  ///< y changes in jumps: across, then up
  double width = 2;
};

struct mark {
  double x;          ///< where a thin vertical line stands
  std::string text;  ///< beside it
};

/// Several curves over linear axes from 0; a curve of one point is a dot. A second scale on the right shows y in other
/// units.
struct plot {
  std::string title;
  std::string subtitle;
  std::string x_label;
  std::string y_label;
  std::string right_label;
  double right_factor = 0;  ///< right scale = factor × y; 0 for none
  double x_end = 1;
  double y_end = 1;
  std::vector<curve> curves;
  std::vector<mark> marks;
};

/// Ticks 1, 2 or 5 times a power of ten apart, about `wanted` of them.
[[nodiscard]] inline double tick_distance(double range, int wanted) {
  const double rough = range / wanted;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  for (const double m : {1.0, 2.0, 5.0}) {
    if (rough <= m * power) {
      return m * power;
    }
  }
  return 10 * power;
}

/// A number as short as a label may be.
[[nodiscard]] inline std::string label_of(double x, double step) {
  std::array<char, 32> text{};
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 12);
  const auto end = std::to_chars(text.data(), text.data() + text.size(), x, std::chars_format::fixed, decimals);
  return {text.data(), end.ptr};
}

inline void write_svg(const std::filesystem::path& path, const plot& p) {
  constexpr double width = 860;
  constexpr double height = 600;
  constexpr double left = 90;
  constexpr double right = width - 90;
  constexpr double top = 84;
  constexpr double bottom = height - 74;
  const auto px = [&](double x) { return left + (right - left) * x / p.x_end; };
  const auto py = [&](double y) { return bottom - (bottom - top) * y / p.y_end; };
  const auto escaped = [](const std::string& text) {
    std::string out;
    for (const char c : text) {
      out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : std::string(1, c);
    }
    return out;
  };

  tetrapore::io::output_file svg(path);
  const auto text = [&](double x, double y, const char* style, const std::string& what) {
    svg << "<text x=\"" << x << "\" y=\"" << y << "\" " << style << ">" << escaped(what) << "</text>\n";
  };
  const auto line = [&](double x1, double y1, double x2, double y2, const char* style) {
    svg << "<line x1=\"" << x1 << "\" y1=\"" << y1 << "\" x2=\"" << x2 << "\" y2=\"" << y2 << "\" " << style << "/>\n";
  };
  svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << width << "\" height=\"" << height
      << "\" viewBox=\"0 0 " << width << ' ' << height
      << "\" font-family=\"Helvetica, Arial, sans-serif\" font-size=\"14\" fill=\"#222\">\n"
      << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      << "<clipPath id=\"frame\"><rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << right - left
      << "\" height=\"" << bottom - top << "\"/></clipPath>\n";
  text(left, 34, "font-size=\"20\" font-weight=\"bold\"", p.title);
  text(left, 58, "fill=\"#555\"", p.subtitle);

  const double dx = tick_distance(p.x_end, 6);
  for (double x = 0; x <= p.x_end * (1 + 1e-9); x += dx) {
    line(px(x), top, px(x), bottom, "stroke=\"#e3e3e3\"");
    text(px(x), bottom + 22, "text-anchor=\"middle\"", label_of(x, dx));
  }
  const double dy = tick_distance(p.y_end, 6);
  for (double y = 0; y <= p.y_end * (1 + 1e-9); y += dy) {
    line(left, py(y), right, py(y), "stroke=\"#e3e3e3\"");
    text(left - 10, py(y) + 5, "text-anchor=\"end\"", label_of(y, dy));
  }
  if (p.right_factor > 0) {
    const double end = p.right_factor * p.y_end;
    const double dr = tick_distance(end, 6);
    for (double r = 0; r <= end * (1 + 1e-9); r += dr) {
      line(right, py(r / p.right_factor), right + 6, py(r / p.right_factor), "stroke=\"#222\"");
      text(right + 11, py(r / p.right_factor) + 5, "text-anchor=\"start\"", label_of(r, dr));
    }
    svg << "<text transform=\"translate(" << width - 24 << ',' << (top + bottom) / 2
        << ") rotate(90)\" text-anchor=\"middle\">" << escaped(p.right_label) << "</text>\n";
  }
  text((left + right) / 2, bottom + 52, "text-anchor=\"middle\" font-size=\"16\"", p.x_label);
  svg << "<text transform=\"translate(28," << (top + bottom) / 2
      << ") rotate(-90)\" text-anchor=\"middle\" font-size=\"16\">" << escaped(p.y_label) << "</text>\n";

  for (const mark& m : p.marks) {
    line(px(m.x), top, px(m.x), bottom, "stroke=\"#888\" stroke-dasharray=\"2 4\"");
    text(px(m.x) + 7, bottom - 12, "fill=\"#555\"", m.text);
  }
  for (const curve& c : p.curves) {
    if (c.x.size() == 1) {
      svg << "<circle cx=\"" << px(c.x[0]) << "\" cy=\"" << py(c.y[0]) << "\" r=\"4\" fill=\"" << c.colour << "\"/>\n";
      continue;
    }
    svg << "<polyline clip-path=\"url(#frame)\" fill=\"none\" stroke=\"" << c.colour << "\" stroke-width=\"" << c.width
        << "\" stroke-linejoin=\"round\"";
    if (!c.dashes.empty()) {
      svg << " stroke-dasharray=\"" << c.dashes << '"';
    }
    svg << " points=\"";
    // Points closer than half a pixel add nothing to the picture.
    double last_x = -1e9;
    double last_y = -1e9;
    const auto point = [&](double x, double y, bool always) {
      const double a = std::round(10 * px(x)) / 10;
      const double b = std::round(10 * py(y)) / 10;
      if (always || std::abs(a - last_x) + std::abs(b - last_y) >= 0.5) {
        svg << a << ',' << b << ' ';
        last_x = a;
        last_y = b;
      }
    };
    for (std::size_t i = 0; i < c.x.size(); ++i) {
      if (c.steps && i > 0) {
        point(c.x[i - 1], c.y[i], false);
      }
      point(c.x[i], c.y[i], i + 1 == c.x.size());
    }
    svg << "\"/>\n";
  }
  svg << "<rect x=\"" << left << "\" y=\"" << top << "\" width=\"" << right - left << "\" height=\"" << bottom - top
      << "\" fill=\"none\" stroke=\"#222\"/>\n";

  const double legend_x = left + 0.42 * (right - left);
  double legend_y = top + 26;
  svg << "<rect x=\"" << legend_x - 12 << "\" y=\"" << top + 8 << "\" width=\"" << right - legend_x + 4
      << "\" height=\"" << 22 * static_cast<double>(p.curves.size()) + 10
      << "\" fill=\"white\" fill-opacity=\"0.9\"/>\n";
  for (const curve& c : p.curves) {
    svg << "<line x1=\"" << legend_x << "\" y1=\"" << legend_y - 5 << "\" x2=\"" << legend_x + 40 << "\" y2=\""
        << legend_y - 5 << "\" stroke=\"" << c.colour << "\" stroke-width=\"" << c.width << "\" stroke-dasharray=\""
        << (c.dashes.empty() ? "none" : c.dashes) << "\"/>\n";
    text(legend_x + 50, legend_y, "", c.name);
    legend_y += 22;
  }
  svg << "</svg>\n";
  svg.commit();
}

}  // namespace support
